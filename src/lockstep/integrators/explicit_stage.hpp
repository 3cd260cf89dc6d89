// Common parts of all explicit methods: workspace, start of a step, and the motion and
// accelerations of a stage.
#pragma once

#include "lockstep/integrators/integration_steps.hpp"
#include "lockstep/integrators/method.hpp"

namespace gearpod::lockstep {

// Workspace of one tile for a method that stores `Kept` accelerations; small enough for the
// first-level cache.
template <class Model, int Kept, int W = Model::kWidth>
struct alignas(64) ExplicitStages {
    using Real = RealOf<Model>;
    Real q[Model::kMaxDegrees * W], v[Model::kMaxDegrees * W];  // of a stage
    Real a[Kept][Model::kMaxDegrees * W];
    typename Model::Pairs pairs;
    Real input[Kept][2 * Model::kMaxSources * W];  // of the sensor
};

// Step `i` of a mesh period: its lengths in seconds, and the motion that it advances.
template <class Model, class State, int W = Model::kWidth>
struct ExplicitStep {
    using Real = RealOf<Model>;
    const Step& step;
    const int channels, size;
    Real* __restrict const q;
    Real* __restrict const v;
    const decltype(position_rounding(std::declval<State&>())) q_rounding;
    alignas(64) Real h[W], half[W];

    GEARPOD_INLINE ExplicitStep(const IntegrationPlan& plan, const typename Model::Lanes& lanes,
                                int i, State& state)
        : step(plan.grid.steps[static_cast<std::size_t>(i)]),
          channels(2 * Model::sources(lanes)),
          size(Model::degrees_of_freedom(lanes) * W),
          q(state.q.data()),
          v(state.v.data()),
          q_rounding(position_rounding(state)) {
        const Real length = static_cast<Real>(step.length);
        for (int l = 0; l < W; ++l) {
            h[l] = length * lanes.mesh_period[l];
            half[l] = Real(0.5) * h[l];
        }
    }
};

// stage_q = q + t dq, stage_v = v + t dv. The outputs may alias the slopes.
template <int W, class Real>
GEARPOD_INLINE void move(int size, const Real* t, const Real* q, const Real* dq, const Real* v,
                         const Real* dv, Real* stage_q, Real* stage_v) {
    for (int j = 0; j < size; j += W) {
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            stage_q[j + l] = std::fma(t[l], dq[j + l], q[j + l]);
            stage_v[j + l] = std::fma(t[l], dv[j + l], v[j + l]);
        }
    }
}

// Accelerations of a motion, and the resulting sensor input.
template <class Model, class Real>
GEARPOD_INLINE void accelerate(const typename Model::Lanes& lanes, const Real* q, const Real* v,
                               const typename Model::Pairs& pairs, Real* a, Real* input) {
    Model::accelerations(lanes, q, v, pairs, a);
    Model::source_accelerations(lanes, q, v, a, input);
}

}  // namespace gearpod::lockstep
