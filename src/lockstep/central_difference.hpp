// Central differences on the steps' middles (the Stoermer-Verlet method that drifts, kicks and
// drifts; Hairer, Lubich and Wanner, Acta Numerica 2003), explicit, order 2, one evaluation a step:
//     x = q + h/2 q',   a = a(x, u),   q += h (q' + h/2 a),   q' += h a.
// The velocity u of dampers and turning frame should be q' + h/2 a. Instead it takes what the step
// before fell short of, u = q' + w / h with w = h^2/2 a of that step; a mesh period's first step
// takes its own, from a second evaluation. So the impulses of the dampers are late by a step but
// none is lost, also where steps of different lengths meet at a contact transition. A step sees the
// stiffness inside itself alone, and jumps between steps cost no order.
#pragma once

#include "lockstep/explicit_stage.hpp"

namespace gearpod::lockstep {

struct CentralDifference {
    template <class Model>
    using Stages = ExplicitStages<Model, 1>;

    template <class Model, class State, class Filter, int W = Model::kWidth>
    static GEARPOD_INLINE void step(const MarchPlan& plan, const typename Model::Lanes& lanes,
                                    const Filter& filter,
                                    const std::vector<PairOverride>& overrides, int i, State& state,
                                    Stages<Model>& s) {
        using Real = RealOf<Model>;
        const ExplicitStep<Model, State> x(plan, lanes, i, state);
        Real* const a = s.a[0];
        double longer = 1.0;  // the step before, over this one
        if (i == 0) {
            std::fill_n(a, x.size, Real(0));
        } else {
            longer = plan.grid.steps[static_cast<std::size_t>(i - 1)].length / x.step.length;
        }
        const Real squared = static_cast<Real>(longer * longer);
        alignas(64) Real reach[W];
        for (int l = 0; l < W; ++l) {
            reach[l] = squared * x.half[l];
        }
        load_pairs<Model>(plan, lanes, overrides, i, 0, s.pairs);
        for (int evaluations = i == 0 ? 2 : 1; evaluations > 0; --evaluations) {
            for (int j = 0; j < x.size; j += W) {
#pragma omp simd
                for (int l = 0; l < W; ++l) {
                    s.q[j + l] = std::fma(x.half[l], x.v[j + l], x.q[j + l]);
                    s.v[j + l] = std::fma(reach[l], a[j + l], x.v[j + l]);
                }
            }
            Model::accelerations(lanes, s.q, s.v, s.pairs, a);
        }
        Model::source_accelerations(lanes, s.q, s.v, a, s.input[0]);
        for (int j = 0; j < x.size; j += W) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                const int at = j + l;
                x.q[at] =
                    advance(x.q[at], x.h[l], std::fma(x.half[l], a[at], x.v[at]), x.q_rest, at);
                x.v[at] = advance(x.v[at], x.h[l], a[at], x.v_rest, at);
            }
        }
        step_filter<W>(filter, x.step, x.channels, state, s.input[0]);
    }
};

}  // namespace gearpod::lockstep
