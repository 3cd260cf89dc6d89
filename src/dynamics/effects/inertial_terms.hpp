// Accelerations that the turning carrier frame adds to a body at (x, y) with velocity (vx, vy):
// Coriolis and centrifugal, Liang (2016), Eqs. 4.2.1-4.2.4 at constant speed. One struct a choice.
#pragma once

#include <cmath>

#include "machine/dispatch.hpp"

namespace gearpod::dynamics {

struct WithInertialTerms {
    static GEARPOD_INLINE double x(double x, double vy, double w) {
        return w * std::fma(w, x, 2.0 * vy);
    }
    static GEARPOD_INLINE double y(double y, double vx, double w) {
        return w * std::fma(w, y, -2.0 * vx);
    }
    // The steady pull r_c Omega^2 on a planet, along its radius.
    static GEARPOD_INLINE double pull(double acceleration, double direction) {
        return acceleration * direction;
    }
};

struct WithoutInertialTerms {
    static GEARPOD_INLINE double x(double, double, double) { return 0.0; }
    static GEARPOD_INLINE double y(double, double, double) { return 0.0; }
    static GEARPOD_INLINE double pull(double, double) { return 0.0; }
};

}  // namespace gearpod::dynamics
