// Central differences on the steps' middles (the Stoermer-Verlet method that drifts, kicks and
// drifts; Hairer, Lubich and Wanner, Acta Numerica 2003), explicit, order 2, one evaluation a step:
//     x = q + h/2 q',   a = a(x, u),   q' += h a,   q = x + h/2 q'.
// The velocity u of dampers and turning frame should be q' + h/2 a. Instead it takes what the step
// before fell short of, u = q' + w / h with w = h^2/2 a of that step; a mesh period's first step
// takes its own, from a second evaluation. So the impulses of the dampers are late by a step but
// none is lost, also where steps of different lengths meet at a contact transition. A step sees the
// stiffness inside itself alone, and jumps between steps cost no order.
#pragma once

#include "lockstep/integrators/explicit_stage.hpp"

namespace gearpod::lockstep {

struct CentralDifference {
    static constexpr const char* kName = "central-difference";
    static constexpr int kOrder = 2;
    static constexpr double kStageNodes[] = {0.5};
    // Its low-pass is off by (2 pi / steps)^2 / 12 there: 7e-4, and 3e-3 with half as many.
    static constexpr double kStepsInBand = 70.0;
    static constexpr StepCost kCost{0.32, 0.34, 0.34};
    // Where no sample parts two steps, positions have drifted to the second one's middle already,
    // this part of its length ahead of the velocities.
    static constexpr double kPositionsAhead = 0.5;

    // The trapezoidal rule with the input at the step's middle alone.
    template <class System>
    static auto filter(const System& s) {
        auto map = s.trapezoidal();
        map.inputs.col(0) *= 2.0;
        map.inputs.col(2).setZero();
        return map;
    }

    // s.v is u. Between two steps that no sample parts, state.q is at the second one's middle.
    template <class Model>
    using Stages = ExplicitStages<Model, 1>;

    template <class Model, class State, class Filter, int W = Model::kWidth>
    static GEARPOD_INLINE void step(const MarchPlan& plan, const typename Model::Lanes& lanes,
                                    const Filter& filter, const MeshOverrides& overrides, int i,
                                    State& state, Stages<Model>& s) {
        using Real = RealOf<Model>;
        const ExplicitStep<Model, State> x(plan, lanes, i, state);
        Real* const a = s.a[0];
        if (i == 0) {
            std::copy_n(x.v, x.size, s.v);
        }
        if (i == 0 || x.step.sample >= 0) {
            for (int j = 0; j < x.size; j += W) {
#pragma omp simd
                for (int l = 0; l < W; ++l) {
                    x.q[j + l] = advance(x.q[j + l], x.half[l], x.v[j + l], x.q_rest, j + l);
                }
            }
        }
        load_pairs<Model>(plan, lanes, overrides, i, 0, s.pairs);
        for (bool again = i == 0;; again = false) {
            Model::accelerations(lanes, x.q, s.v, s.pairs, a);
            if (!again) {
                break;
            }
            for (int j = 0; j < x.size; j += W) {
#pragma omp simd
                for (int l = 0; l < W; ++l) {
                    s.v[j + l] = std::fma(x.half[l], a[j + l], x.v[j + l]);
                }
            }
        }
        Model::source_accelerations(lanes, x.q, s.v, a, s.input[0]);
        const Ahead<Real, W> ahead(plan, i, lanes.mesh_period, x.half);
        for (int j = 0; j < x.size; j += W) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                const int at = j + l;
                const Real v = std::fma(x.h[l], a[at], x.v[at]);
                x.v[at] = v;
                x.q[at] = advance(x.q[at], ahead.drift[l], v, x.q_rest, at);
                s.v[at] = std::fma(ahead.reach[l], a[at], v);
            }
        }
        step_filter<W>(filter, x.step, x.channels, state, s.input[0]);
    }

  private:
    // From a step's middle to its end, or on to the next one's middle; and what brings the end's
    // velocity to the next u. Seconds.
    template <class Real, int W>
    struct Ahead {
        alignas(64) Real drift[W], reach[W];

        GEARPOD_INLINE Ahead(const MarchPlan& plan, int i, const Real* period, const Real* half) {
            const auto now = static_cast<std::size_t>(i);
            const bool last = now + 1 == plan.grid.steps.size();
            const Step& next = plan.grid.steps[last ? now : now + 1];
            const bool stops = last || next.sample >= 0;
            const Real further = stops ? Real(0) : static_cast<Real>(0.5 * next.length);
            const Real ratio = static_cast<Real>(plan.grid.steps[now].length / next.length);
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                drift[l] = std::fma(further, period[l], half[l]);
                reach[l] = ratio * half[l];
            }
        }
    };
};

}  // namespace gearpod::lockstep
