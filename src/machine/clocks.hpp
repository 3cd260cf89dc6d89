// Monotonic wall-clock time, unaffected by changes of the date.
#pragma once

#include <chrono>
#include <ctime>

namespace gearpod::mc {

using WallClock = std::chrono::steady_clock;

inline double seconds_since(WallClock::time_point start) {
    return std::chrono::duration<double>(WallClock::now() - start).count();
}

// Processor time of the calling thread: the cost of a computation, independent of other load on the
// machine.

// Seconds since some fixed moment (POSIX CLOCK_THREAD_CPUTIME_ID).
inline double thread_processor_s() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace gearpod::mc
