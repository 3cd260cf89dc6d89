// Time by the clock on the wall, which no change of the date moves.
#pragma once

#include <chrono>

namespace gearpod::mc {

using WallClock = std::chrono::steady_clock;

inline double seconds_since(WallClock::time_point start) {
    return std::chrono::duration<double>(WallClock::now() - start).count();
}

}  // namespace gearpod::mc
