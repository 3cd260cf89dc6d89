// Models of a train with fluctuating speed. The frame of x and y rotates with the speed and angular
// acceleration of the stage node (SpeedValue). The inertia forces of the masses under this
// acceleration are among the time-varying forces (dynamics::angular_acceleration_force).
#pragma once

#include <algorithm>
#include <cmath>

#include "dynamics/fixed_shaft_motion.hpp"
#include "dynamics/planetary_motion.hpp"
#include "lockstep/excitation/forced_motion.hpp"
#include "lockstep/integrators/explicit_stage.hpp"
#include "lockstep/integrators/runge_kutta.hpp"

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

// Classical Runge-Kutta method in mesh phase for a train with fluctuating speed:
//   dq/dphase = T v,   dv/dphase = T a(q, v),   dz/dphase = T (A z + b u)
// where T is the seconds per mesh period at the stage nodes. The sensor's low-pass filter z
// (sensor_filter.hpp) is defined in time. It is therefore integrated together with the motion and
// needs no precomputed coefficients.
struct VariableSpeedRungeKutta4 {
    template <class Model, int W = Model::kWidth>
    struct alignas(64) Stages : ExplicitStages<Model, 3> {
        // Step length, s, at the speed of each stage node, and half of the first two.
        alignas(64) double h[3][W], half[2][W];
    };

    template <class Model, class State, class Filter, int W = Model::kWidth>
    static GEARPOD_INLINE void step(const IntegrationPlan& plan, const typename Model::Lanes& lanes,
                                    const Filter&, const MeshOverrides& overrides, int i,
                                    State& state, Stages<Model>& s) {
        const int channels = 2 * Model::sources(lanes);
        const int size = Model::degrees_of_freedom(lanes) * W;
        double* __restrict q = state.q.data();
        double* __restrict v = state.v.data();
        const double* const h1 = s.h[2];

        for (int node = 0; node < 3; ++node) {
            load_length<Model>(plan, lanes, i, node, s);
        }
        for (int l = 0; l < W; ++l) {
            s.half[0][l] = 0.5 * s.h[0][l];
            s.half[1][l] = 0.5 * s.h[1][l];
        }
        // A loop makes the compiler emit the accelerations only once.
        for (int stage = 0; stage < 4; ++stage) {
            if (stage != 2) {
                load_node<Model>(plan, lanes, overrides, i, (stage + 1) / 2, s);
            }
            const double* const from_q = stage == 0 ? q : s.q;
            const double* const from_v = stage == 0 ? v : s.v;
            double* const a = s.a[stage % 3];
            accelerate<Model>(lanes, from_q, from_v, s, a, s.input[std::min(stage, 2)]);
            if (stage < 2) {
                move<W>(size, s.half[stage], q, from_v, v, a, s.q, s.v);
            } else if (stage == 2) {
                advance_before_last_stage<Model>(size, channels, q, v, s);
            }
        }
        for (int j = 0; j < size; j += W) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                v[j + l] = std::fma(h1[l] / 6.0, s.a[0][j + l], v[j + l]);
            }
        }
        for (int channel = 0; channel < channels; ++channel) {
            low_pass<Model>(plan.low_pass_rad_s, channel * W, s,
                            state.filter.data() + channel * W * kFilterStates);
        }
    }

  private:
    // Adds all but the last stage's contribution to the velocity; sets s.q and s.v to the last
    // stage's arguments.
    template <class Model, int W = Model::kWidth>
    static GEARPOD_INLINE void advance_before_last_stage(int size, int channels,
                                                         double* __restrict q, double* __restrict v,
                                                         Stages<Model>& s) {
        const double *const h0 = s.h[0], *const hm = s.h[1], *const h1 = s.h[2];
        for (int j = 0; j < channels * W; ++j) {
            s.input[1][j] = 0.5 * (s.input[1][j] + s.input[2][j]);
        }
        for (int j = 0; j < size; j += W) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                // The position rates at the four stages are v, v + h0 a1 / 2, v + hm a2 / 2 and v +
                // hm a3.
                const double all = (h0[l] + 4.0 * hm[l] + h1[l]) / 6.0;
                const double change = std::fma(hm[l] * h0[l], s.a[0][j + l],
                                               std::fma(hm[l] * hm[l], s.a[1][j + l],
                                                        hm[l] * h1[l] * s.a[2][j + l])) /
                                      6.0;
                const double later = std::fma(hm[l], s.v[j + l], q[j + l]);
                const double start = v[j + l];
                s.q[j + l] = later;
                s.v[j + l] = std::fma(hm[l], s.a[2][j + l], start);
                q[j + l] = std::fma(all, start, q[j + l] + change);
                v[j + l] = std::fma(h0[l] / 6.0, s.a[0][j + l],
                                    std::fma(hm[l] / 3.0, s.a[1][j + l] + s.a[2][j + l], start));
            }
        }
    }

    template <class Model, int W = Model::kWidth>
    static GEARPOD_INLINE void load_length(const IntegrationPlan& plan,
                                           const typename Model::Lanes& lanes, int i, int node,
                                           Stages<Model>& s) {
        const double length = plan.grid.steps[static_cast<std::size_t>(i)].length;
        const double* period = lanes.excitation_forces.speed_value(
            lanes.excitation_forces.row(i, node), mesh_period_value);
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            s.h[node][l] = length * period[l];
        }
    }

    // Loads meshes and forces at a stage node. Transmission errors are functions of the phase, so
    // their rates are proportional to the speed.
    template <class Model, int W = Model::kWidth>
    static GEARPOD_INLINE void load_node(const IntegrationPlan& plan,
                                         const typename Model::Lanes& lanes,
                                         const MeshOverrides& overrides, int i, int node,
                                         Stages<Model>& s) {
        load_pairs<Model>(plan, lanes, overrides, i, node, s.pairs);
        if constexpr (Model::Mesh::kHasError) {
            const double* speed =
                lanes.excitation_forces.speed_value(s.pairs.row, relative_speed_value);
            for (int pair = 0; pair < plan.nodes.pairs; ++pair) {
#pragma omp simd
                for (int l = 0; l < W; ++l) {
                    s.pairs.de[pair * W + l] *= speed[l];
                }
            }
        }
    }

    template <class Model, int W = Model::kWidth>
    static GEARPOD_INLINE void accelerate(const typename Model::Lanes& lanes, const double* q,
                                          const double* v, const Stages<Model>& s, double* a,
                                          double* input) {
        Model::accelerations(lanes, q, v, s.pairs, a);
        Model::source_accelerations(lanes, q, v, a, s.pairs.row, input);
    }

    // Filter states of one gearbox and channel: two sections in series, input to x and x to y
    // (sensor_filter.hpp).
    struct Sections {
        double x, dx, y, dy;
    };

    static GEARPOD_INLINE Sections rates(double w, const Sections& f, double u) {
        return {f.dx, w * std::fma(w, u - f.x, -kFilterDamping[0] * f.dx), f.dy,
                w * std::fma(w, f.x - f.y, -kFilterDamping[1] * f.dy)};
    }

    static GEARPOD_INLINE Sections moved(const Sections& f, double h, const Sections& rate) {
        return {std::fma(h, rate.x, f.x), std::fma(h, rate.dx, f.dx), std::fma(h, rate.y, f.y),
                std::fma(h, rate.dy, f.dy)};
    }

    template <class Model, int W = Model::kWidth>
    static GEARPOD_INLINE void low_pass(double w, int index, const Stages<Model>& s,
                                        double* __restrict filter) {
        const double* __restrict u0 = s.input[0] + index;
        const double* __restrict um = s.input[1] + index;
        const double* __restrict u1 = s.input[2] + index;
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            const double h0 = s.h[0][l], hm = s.h[1][l], h1 = s.h[2][l];
            const Sections f{filter[l], filter[W + l], filter[2 * W + l], filter[3 * W + l]};
            const Sections k1 = rates(w, f, u0[l]);
            const Sections k2 = rates(w, moved(f, 0.5 * h0, k1), um[l]);
            const Sections k3 = rates(w, moved(f, 0.5 * hm, k2), um[l]);
            const Sections k4 = rates(w, moved(f, hm, k3), u1[l]);
            const Sections first = moved(moved(f, h0 / 6.0, k1), hm / 3.0, k2);
            const Sections end = moved(moved(first, hm / 3.0, k3), h1 / 6.0, k4);
            filter[l] = end.x;
            filter[W + l] = end.dx;
            filter[2 * W + l] = end.y;
            filter[3 * W + l] = end.dy;
        }
    }
};

// Maps a method to its variant for variable speed.
template <class Method>
struct VariableSpeed;
template <>
struct VariableSpeed<RungeKutta4> {
    using Type = VariableSpeedRungeKutta4;
};

}  // namespace gearpod::lockstep
