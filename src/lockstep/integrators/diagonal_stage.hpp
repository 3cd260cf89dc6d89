// Stages of implicit integrators whose own acceleration A enters with one coefficient a (s): the
// velocity is V = v + a A and the position Q = x + a (a A).
#pragma once

#include <cmath>

#include "lockstep/integrators/implicit_stage.hpp"
#include "lockstep/integrators/integration_steps.hpp"

namespace gearpod::lockstep {

// Computes the stage at a node of step i: its acceleration, velocities, positions and the sensor's
// input. x and v are positions and velocities without the stage's own acceleration; span.a is the
// coefficient and span.b its square.
template <class Model, int W = Model::kWidth>
GEARPOD_INLINE void diagonal_stage(const IntegrationPlan& plan, const typename Model::Lanes& lanes,
                                   const MeshOverrides& overrides, int i, int node,
                                   const StageSpan<W>& span, const double* x, const double* v,
                                   double* __restrict acceleration, double* __restrict velocities,
                                   double* __restrict positions, double* __restrict input,
                                   StageScratch<Model>& meshes) {
    const int kind = plan.grid.steps[static_cast<std::size_t>(i)].kind;
    load_pairs<Model>(plan, lanes, overrides, i, node, meshes.pairs);
    implicit_stage<Model>(lanes, lanes.block(kind), span, x, v, acceleration, meshes);
    for (int j = 0; j < lanes.degrees * W; j += W) {
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            const double rise = span.a[l] * acceleration[j + l];
            velocities[j + l] = v[j + l] + rise;
            positions[j + l] = std::fma(span.a[l], rise, x[j + l]);
        }
    }
    Model::source_accelerations(lanes, positions, velocities, acceleration, input);
}

// Begins step i by the trapezoidal rule: computes the acceleration at the step's start with the
// stiffness just after it, the sensor's input there, and x and v of the diagonal stage at the end
// of the rule's interval, whose coefficient is span.a.
template <class Model, int W = Model::kWidth>
GEARPOD_INLINE void begin_trapezoid(const IntegrationPlan& plan, const typename Model::Lanes& lanes,
                                    const MeshOverrides& overrides, int i, const StageSpan<W>& span,
                                    const TileState& state, double* __restrict acceleration,
                                    double* __restrict x, double* __restrict v,
                                    double* __restrict input, StageScratch<Model>& meshes) {
    const double* __restrict start_q = state.q.data();
    const double* __restrict start_v = state.v.data();
    load_pairs<Model>(plan, lanes, overrides, i, 0, meshes.pairs);
    implicit_stage<Model>(lanes, lanes.block_at_rest(), StageSpan<W>{}, start_q, start_v,
                          acceleration, meshes);
    Model::source_accelerations(lanes, start_q, start_v, acceleration, input);
    for (int j = 0; j < lanes.degrees * W; j += W) {
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            const double vj = std::fma(span.a[l], acceleration[j + l], start_v[j + l]);
            v[j + l] = vj;
            x[j + l] = std::fma(span.a[l], start_v[j + l] + vj, start_q[j + l]);
        }
    }
}

}  // namespace gearpod::lockstep
