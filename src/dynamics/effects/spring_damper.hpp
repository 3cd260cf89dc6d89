// The force that every spring-damper of the lockstep motions gives.
#pragma once

#include <cmath>

#include "machine/dispatch.hpp"

namespace gearpod::dynamics {

// Force of a spring-damper with deflection d and rate r.
GEARPOD_INLINE double spring_damper(double k, double d, double c, double r) {
    return std::fma(k, d, c * r);
}

}  // namespace gearpod::dynamics
