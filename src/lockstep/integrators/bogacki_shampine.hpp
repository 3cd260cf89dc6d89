// Explicit embedded pair of Bogacki and Shampine (1989), orders 3 and 2. Three stages give the step
// of order 3. A fourth stage, at the end of the step, is needed only to estimate the difference
// from the embedded method of order 2. Because the stiffness may jump between steps, it cannot
// serve as the first stage of the next step. It is therefore omitted, unless the plan's stage nodes
// include 1 to request the estimate (see step_pilot.hpp).
#pragma once

#include "lockstep/integrators/explicit_stage.hpp"

namespace gearpod::lockstep {

struct BogackiShampine {
    static constexpr const char* kName = "bs3";
    static constexpr int kOrder = 3;
    static constexpr double kStageNodes[] = {0.0, 0.5, 0.75};
    static constexpr double kStepsInBand = 20.0;
    static constexpr StepCost kCost{0.9, 0.9, 0.9};
    static constexpr std::size_t kEstimateNode = 3;  // index of node 1 among the stage nodes

    template <class Complex>
    static Complex growth(Complex z) {
        return 1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0));
    }

    template <class System>
    static auto filter(const System& s) {
        const auto z = s.start();
        const auto k1 = s.slope(z, 0);
        const auto k2 = s.slope(z + k1 / 2.0, 1);
        const auto k3 = s.slope(z + 0.75 * k2, 2);
        return s.map(z + (2.0 * k1 + 3.0 * k2 + 4.0 * k3) / 9.0);
    }

    template <class Model, int W = Model::kWidth>
    struct alignas(64) Stages : ExplicitStages<Model, 4> {
        RealOf<Model> estimate[kEstimateRows * W] = {};  // see MeshRecord::estimate
    };

    template <class Model, class State, class Filter, int W = Model::kWidth>
    static GEARPOD_INLINE void step(const IntegrationPlan& plan, const typename Model::Lanes& lanes,
                                    const Filter& filter, const MeshOverrides& overrides, int i,
                                    State& state, Stages<Model>& s) {
        using Real = RealOf<Model>;
        const ExplicitStep<Model, State> x(plan, lanes, i, state);
        alignas(64) Real most[W], ninth[W], sixth[W];
        for (int l = 0; l < W; ++l) {
            most[l] = Real(0.75) * x.h[l];
            ninth[l] = x.h[l] / Real(9);
            sixth[l] = x.h[l] / Real(6);
        }

        const bool estimates = plan.grid.stage_nodes.size() > kEstimateNode;
        // A loop makes the compiler emit the accelerations only once.
        for (int stage = 0; stage < (estimates ? 4 : 3); ++stage) {
            const Real* const from_q = stage == 0 ? x.q : s.q;
            const Real* const from_v = stage == 0 ? x.v : s.v;
            load_pairs<Model>(plan, lanes, overrides, i, stage, s.pairs);
            accelerate<Model>(lanes, from_q, from_v, s.pairs, s.a[stage], s.input[stage]);
            if (stage < 2) {
                move<W>(x.size, stage == 0 ? x.half : most, x.q, from_v, x.v, s.a[stage], s.q, s.v);
            } else if (stage == 2 && estimates) {
                end_of_step<Model>(x, s);
            }
        }
        if (estimates) {
            estimate<Model>(x, s);
        }
        for (int j = 0; j < x.size; j += W) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                // The stage slopes have the weights 2/9, 3/9 and 4/9. The velocity slopes follow
                // from the first two accelerations.
                const int at = j + l;
                const Real a1 = s.a[0][at], a2 = s.a[1][at], a3 = s.a[2][at];
                const Real slope = std::fma(sixth[l], std::fma(Real(2), a2, a1), x.v[at]);
                const Real rise = std::fma(Real(2), a1, std::fma(Real(3), a2, Real(4) * a3));
                x.q[at] = advance(x.q[at], x.h[l], slope, x.q_rounding, at);
                x.v[at] = std::fma(ninth[l], rise, x.v[at]);
            }
        }
        step_filter<W>(filter, x.step, x.channels, state, s.input[0], s.input[1], s.input[2]);
    }

  private:
    // Sets s.q and s.v to the arguments of the fourth stage.
    template <class Model, class Step, int W = Model::kWidth>
    static GEARPOD_INLINE void end_of_step(const Step& x, Stages<Model>& s) {
        using Real = RealOf<Model>;
        for (int j = 0; j < x.size; ++j) {
            const Real t = x.h[j % W];
            s.q[j] = x.q[j] + t * (x.v[j] + t / Real(6) * (s.a[0][j] + Real(2) * s.a[1][j]));
            s.v[j] = x.v[j] + t / Real(9) *
                                  (Real(2) * s.a[0][j] + Real(3) * s.a[1][j] + Real(4) * s.a[2][j]);
        }
    }

    // Estimates the error as the difference between orders 3 and 2, from the four stages.
    template <class Model, class Step, int W = Model::kWidth>
    static GEARPOD_INLINE void estimate(const Step& x, Stages<Model>& s) {
        using Real = RealOf<Model>;
        std::fill_n(s.estimate, kEstimateRows * W, Real(0));
        const auto keep_largest = [&s](int row, int lane, Real value) {
            Real& largest = s.estimate[row * W + lane];
            largest = std::abs(value) > largest ? std::abs(value) : largest;
        };
        for (int j = 0; j < x.size; ++j) {
            const int l = j % W;
            const Real h = x.h[l], v = x.v[j];
            const Real v2 = v + Real(0.5) * h * s.a[0][j];
            const Real v3 = v + Real(0.75) * h * s.a[1][j];
            keep_largest(0, l, s.q[j]);
            keep_largest(1, l, s.v[j]);
            keep_largest(
                2, l,
                h / Real(72) * (Real(6) * v2 + Real(8) * v3 - Real(5) * v - Real(9) * s.v[j]));
            keep_largest(3, l,
                         h / Real(72) *
                             (Real(6) * s.a[1][j] + Real(8) * s.a[2][j] - Real(5) * s.a[0][j] -
                              Real(9) * s.a[3][j]));
        }
    }
};

}  // namespace gearpod::lockstep
