// What a distribution can draw.
#pragma once

namespace gearpod::mc {

// Smallest and largest value that can be drawn; +-infinity where unbounded.
struct Support {
    double low = 0.0;
    double high = 0.0;
    bool low_open = false;  // the bound itself is never drawn
    bool high_open = false;
};

}  // namespace gearpod::mc
