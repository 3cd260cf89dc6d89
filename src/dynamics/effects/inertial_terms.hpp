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

// Absolute acceleration along the axes of a frame that turns with w, whatever the model's choice:
// (x'' - 2 w y' - w^2 x, y'' + 2 w x' - w^2 y).
GEARPOD_INLINE double absolute_x(double ax, double x, double vy, double w) {
    return std::fma(-w, std::fma(w, x, 2.0 * vy), ax);
}
GEARPOD_INLINE double absolute_y(double ay, double y, double vx, double w) {
    return std::fma(-w, std::fma(w, y, -2.0 * vx), ay);
}

}  // namespace gearpod::dynamics
