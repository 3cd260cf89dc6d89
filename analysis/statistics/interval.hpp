// Bounds of an estimate.
#pragma once

namespace gearpod::analysis {

struct Interval {
    double lower = 0.0;
    double upper = 1.0;
};

}  // namespace gearpod::analysis
