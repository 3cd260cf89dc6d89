// The force that every spring-damper of the lockstep motions gives.
#pragma once

#include <cmath>

#include "machine/dispatch.hpp"

namespace gearpod::dynamics {

// Force of a spring-damper with deflection d and rate r.
template <class Real>
GEARPOD_INLINE Real spring_damper(Real k, Real d, Real c, Real r) {
    return std::fma(k, d, c * r);
}

}  // namespace gearpod::dynamics
