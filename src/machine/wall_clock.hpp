// Monotonic wall-clock time, unaffected by changes of the date.
#pragma once

#include <chrono>

namespace gearpod::mc {

using WallClock = std::chrono::steady_clock;

inline double seconds_since(WallClock::time_point start) {
    return std::chrono::duration<double>(WallClock::now() - start).count();
}

}  // namespace gearpod::mc
