// Support of a distribution.
#pragma once

namespace gearpod::mc {

// Infimum and supremum of the values; +-infinity where unbounded.
struct Support {
    double low = 0.0;
    double high = 0.0;
    bool low_open = false;  // the bound itself never occurs
    bool high_open = false;
};

}  // namespace gearpod::mc
