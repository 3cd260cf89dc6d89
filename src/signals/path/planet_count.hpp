// Number of planets as a template argument. With unrolled loops over planets, the sums of a sample
// stay in registers.
#pragma once

#include "machine/dispatch.hpp"

namespace gearpod::signals {

inline constexpr int kMaxPathPlanets = 8;

// Calls task.operator()<N>() for the given number of planets, 1..kMaxPathPlanets.
template <int N = 1, typename Task>
GEARPOD_INLINE void with_planets(int planets, Task task) {
    if constexpr (N < kMaxPathPlanets) {
        if (planets != N) {
            return with_planets<N + 1>(planets, task);
        }
    }
    task.template operator()<N>();
}

}  // namespace gearpod::signals
