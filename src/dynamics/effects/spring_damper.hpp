// Force of a spring-damper, common to all lockstep models.
#pragma once

#include <cmath>

#include "machine/dispatch.hpp"

namespace gearpod::dynamics {

// Force for deflection d and rate r.
template <class Real>
GEARPOD_INLINE Real spring_damper(Real k, Real d, Real c, Real r) {
    return std::fma(k, d, c * r);
}

}  // namespace gearpod::dynamics
