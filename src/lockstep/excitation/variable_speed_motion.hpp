// Models of a train with fluctuating speed. The frame of x and y rotates with the speed and angular
// acceleration of the stage node (SpeedValue). The inertia forces of the masses under this
// acceleration are among the time-varying forces (dynamics::angular_acceleration_force).
#pragma once

#include <cmath>

#include "dynamics/fixed_shaft_motion.hpp"
#include "dynamics/torsional_motion.hpp"
#include "dynamics/translational_motion.hpp"
#include "lockstep/excitation/forced_motion.hpp"

namespace gearpod::lockstep {

// Speed w (rad/s) and angular acceleration dw (rad/s^2) of the carrier at a stage node.
template <int W>
struct alignas(64) FrameRotation {
    double w[W], dw[W];

    template <class Lanes>
    GEARPOD_INLINE FrameRotation(const Lanes& p, const double* row) {
        const double* speed = p.excitation_forces.speed_value(row, relative_speed_value);
        const double* change = p.excitation_forces.speed_value(row, speed_rate_value);
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            w[l] = p.speed[l] * speed[l];
            dw[l] = p.speed[l] * change[l];
        }
    }
    // Apparent acceleration of a body at (x, y) with velocity (vx, vy) in the frame: Coriolis,
    // centrifugal and Euler terms of Liang (2016), Eqs. 4.2.1-4.2.4.
    GEARPOD_INLINE double x(int l, double x, double y, double vy) const {
        return std::fma(w[l], std::fma(w[l], x, 2.0 * vy), dw[l] * y);
    }
    GEARPOD_INLINE double y(int l, double x, double y, double vx) const {
        return std::fma(w[l], std::fma(w[l], y, -2.0 * vx), -dw[l] * x);
    }
};

template <bool kInertialTerms, class MeshLaw, int W>
struct VariableSpeedTranslational
    : Forced<dynamics::TranslationalMotion<dynamics::WithoutInertialTerms, MeshLaw, W>> {
    using Base = Forced<dynamics::TranslationalMotion<dynamics::WithoutInertialTerms, MeshLaw, W>>;
    using typename Base::Lanes;
    using typename Base::Pairs;

    static GEARPOD_INLINE void accelerations(const Lanes& p, const double* __restrict q,
                                             const double* __restrict v, const Pairs& pairs,
                                             double* __restrict a) {
        Base::accelerations(p, q, v, pairs, a);
        if constexpr (kInertialTerms) {
            const FrameRotation<W> frame(p, pairs.row);
            for (int body = 0; body < 3 + p.planets; ++body) {
                const int x = 3 * body * W, y = x + W;
#pragma omp simd
                for (int l = 0; l < W; ++l) {
                    a[x + l] += frame.x(l, q[x + l], q[y + l], v[y + l]);
                    a[y + l] += frame.y(l, q[x + l], q[y + l], v[x + l]);
                }
            }
            add_centrifugal_acceleration(p, pairs.row, a);
        }
    }

    static GEARPOD_INLINE void source_accelerations(const Lanes& p, const double* q,
                                                    const double* v, const double* a,
                                                    const double* row, double* __restrict out) {
        const FrameRotation<W> frame(p, row);
        for (int n = 0; n < p.sources; ++n) {
            const int x = dynamics::source_motion_index(p.planets, n) * W, y = x + W;
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                out[2 * n * W + l] = a[x + l] - frame.x(l, q[x + l], q[y + l], v[y + l]);
                out[(2 * n + 1) * W + l] = a[y + l] - frame.y(l, q[x + l], q[y + l], v[x + l]);
            }
        }
    }

  private:
    // Adds the centrifugal acceleration r_c w^2 along each planet's radius.
    static GEARPOD_INLINE void add_centrifugal_acceleration(const Lanes& p, const double* row,
                                                            double* __restrict a) {
        const double* speed = p.excitation_forces.speed_value(row, relative_speed_value);
        for (int n = 0; n < p.planets; ++n) {
            const int x = (9 + 3 * n) * W;
            const double cosine = p.cos_psi[n], sine = p.sin_psi[n];
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                const double pull = p.centrifugal[l] * speed[l] * speed[l];
                a[x + l] = std::fma(pull, cosine, a[x + l]);
                a[x + W + l] = std::fma(pull, sine, a[x + W + l]);
            }
        }
    }
};

template <class MeshLaw, int W>
struct VariableSpeedTorsional : Forced<dynamics::TorsionalMotion<MeshLaw, W>> {
    using typename Forced<dynamics::TorsionalMotion<MeshLaw, W>>::Lanes;

    static GEARPOD_INLINE void source_accelerations(const Lanes& p, const double* q,
                                                    const double* v, const double* a,
                                                    const double* row, double* __restrict out) {
        const FrameRotation<W> frame(p, row);
        for (int n = 0; n < p.planets; ++n) {
            const double x = -p.sin_psi[n], y = p.cos_psi[n];
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                out[2 * n * W + l] = a[l] * x - frame.x(l, q[l] * x, q[l] * y, v[l] * y);
                out[(2 * n + 1) * W + l] = a[l] * y - frame.y(l, q[l] * x, q[l] * y, v[l] * x);
            }
        }
    }
};

template <class MeshLaw, int W>
struct VariableSpeedFixedShaft : Forced<dynamics::FixedShaftMotions<MeshLaw, W>> {
    using Base = Forced<dynamics::FixedShaftMotions<MeshLaw, W>>;
    using typename Base::Lanes;

    static GEARPOD_INLINE void source_accelerations(const Lanes& p, const double* q,
                                                    const double* v, const double* a,
                                                    const double* /*row*/, double* __restrict out) {
        Base::source_accelerations(p, q, v, a, out);
    }
};

}  // namespace gearpod::lockstep
