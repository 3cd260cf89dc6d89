// Classical explicit Runge-Kutta method, order 4: q'' = a(q, q') with the stiffness at the step's
// start, middle and end. The same method integrates the sensor's low-pass filter together with the
// motion.
#pragma once

#include <algorithm>

#include "lockstep/integrators/explicit_stage.hpp"

namespace gearpod::lockstep {

struct RungeKutta4 {
    static constexpr const char* kName = "rk4";
    static constexpr int kOrder = 4;
    static constexpr double kStageNodes[] = {0.0, 0.5, 1.0};
    static constexpr double kStepsInBand = 20.0;
    static constexpr StepCost kCost{1.0, 1.0, 1.0};

    template <class Complex>
    static Complex growth(Complex z) {
        return 1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0)));
    }

    template <class System>
    static auto filter(const System& s) {
        const auto one = s.one();
        const auto a2 = (s.a * s.a).eval();
        const auto a3 = (a2 * s.a).eval();
        typename System::Map map;
        map.transition = one + s.a + a2 / 2.0 + a3 / 6.0 + a3 * s.a / 24.0;
        map.inputs.col(0) = s.h / 6.0 * (one + s.a + a2 / 2.0 + a3 / 4.0) * s.b;
        map.inputs.col(1) = s.h / 6.0 * (4.0 * one + 2.0 * s.a + a2 / 2.0) * s.b;
        map.inputs.col(2) = s.h / 6.0 * s.b;
        return map;
    }

    template <class Model>
    using Stages = ExplicitStages<Model, 3>;

    // The stage positions and velocities follow from the stage accelerations, so only those are
    // stored.
    template <class Model, class State, class Filter, int W = Model::kWidth>
    static GEARPOD_INLINE void step(const IntegrationPlan& plan, const typename Model::Lanes& lanes,
                                    const Filter& filter, const MeshOverrides& overrides, int i,
                                    State& state, Stages<Model>& s) {
        using Real = RealOf<Model>;
        const ExplicitStep<Model, State> x(plan, lanes, i, state);
        alignas(64) Real sixth[W];
        for (int l = 0; l < W; ++l) {
            sixth[l] = x.h[l] / Real(6);
        }

        // A loop makes the compiler emit the accelerations only once.
        for (int stage = 0; stage < 4; ++stage) {
            if (stage != 2) {
                load_pairs<Model>(plan, lanes, overrides, i, (stage + 1) / 2, s.pairs);
            }
            const Real* const from_q = stage == 0 ? x.q : s.q;
            const Real* const from_v = stage == 0 ? x.v : s.v;
            Real* const a = s.a[stage % 3];
            accelerate<Model>(lanes, from_q, from_v, s.pairs, a, s.input[std::min(stage, 2)]);
            if (stage < 2) {
                move<W>(x.size, x.half, x.q, from_v, x.v, a, s.q, s.v);
            } else if (stage == 2) {
                advance_before_last_stage<Model>(x, sixth, s);
            }
        }
        for (int j = 0; j < x.size; j += W) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                x.v[j + l] = std::fma(sixth[l], s.a[0][j + l], x.v[j + l]);
            }
        }
        step_filter<W>(filter, x.step, x.channels, state, s.input[0], s.input[1], s.input[2]);
    }

  private:
    // Adds all but the last stage's contribution to the velocity; sets s.q and s.v to the last
    // stage's arguments.
    template <class Model, class Step, class Real, int W = Model::kWidth>
    static GEARPOD_INLINE void advance_before_last_stage(const Step& x, const Real* sixth,
                                                         Stages<Model>& s) {
        for (int j = 0; j < x.channels * W; j += W) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                s.input[1][j + l] = Real(0.5) * (s.input[1][j + l] + s.input[2][j + l]);
            }
        }
        for (int j = 0; j < x.size; j += W) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                const int at = j + l;
                const Real sum = s.a[1][at] + s.a[2][at];
                s.q[at] = std::fma(x.h[l], s.v[at], x.q[at]);
                s.v[at] = std::fma(x.h[l], s.a[2][at], x.v[at]);
                // New position, and the part of the new velocity known before the last stage.
                x.q[at] = advance(x.q[at], x.h[l], std::fma(sixth[l], s.a[0][at] + sum, x.v[at]),
                                  x.q_rounding, at);
                x.v[at] = std::fma(sixth[l], std::fma(Real(2), sum, s.a[0][at]), x.v[at]);
            }
        }
    }
};

}  // namespace gearpod::lockstep
