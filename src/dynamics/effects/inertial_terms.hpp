// Inertial accelerations in the rotating carrier frame of a body at (x, y) with velocity (vx, vy):
// Coriolis and centrifugal terms of Liang (2016), Eqs. 4.2.1-4.2.4, at constant speed. One struct
// includes them, the other omits them.
#pragma once

#include <cmath>

#include "machine/instruction_sets.hpp"

namespace gearpod::dynamics {

struct WithInertialTerms {
    template <class Real>
    static GEARPOD_INLINE Real x(Real x, Real vy, Real w) {
        return w * std::fma(w, x, Real(2) * vy);
    }
    template <class Real>
    static GEARPOD_INLINE Real y(Real y, Real vx, Real w) {
        return w * std::fma(w, y, Real(-2) * vx);
    }
    // Part of the constant centrifugal acceleration r_c Omega^2 of a planet along an axis;
    // `direction` is the cosine of the angle between that axis and the planet's radius.
    template <class Real>
    static GEARPOD_INLINE Real centrifugal_acceleration(Real acceleration, Real direction) {
        return acceleration * direction;
    }
};

struct WithoutInertialTerms {
    template <class Real>
    static GEARPOD_INLINE Real x(Real, Real, Real) {
        return 0;
    }
    template <class Real>
    static GEARPOD_INLINE Real y(Real, Real, Real) {
        return 0;
    }
    template <class Real>
    static GEARPOD_INLINE Real centrifugal_acceleration(Real, Real) {
        return 0;
    }
};

// Absolute acceleration along the axes of a frame that rotates with w: (x'' - 2 w y' - w^2 x, y'' +
// 2 w x' - w^2 y). It applies whether or not the model includes inertial terms.
template <class Real>
GEARPOD_INLINE Real absolute_x(Real ax, Real x, Real vy, Real w) {
    return std::fma(-w, std::fma(w, x, Real(2) * vy), ax);
}
template <class Real>
GEARPOD_INLINE Real absolute_y(Real ay, Real y, Real vx, Real w) {
    return std::fma(-w, std::fma(w, y, Real(-2) * vx), ay);
}

}  // namespace gearpod::dynamics
