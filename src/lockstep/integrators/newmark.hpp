#pragma once

#include "lockstep/integrators/implicit_stage.hpp"
#include "lockstep/integrators/integration_steps.hpp"

namespace gearpod::lockstep {

// Newmark's method with average acceleration (1959; beta 1/4, gamma 1/2), order 2. The acceleration
// at a step's start is recomputed with the stiffness just after it, so that the order survives the
// jumps at contact transitions.
struct Newmark {
    static constexpr const char* kName = "newmark";
    static constexpr int kOrder = 2;
    static constexpr double kStageNodes[] = {0.0, 1.0};
    static constexpr double kStepsInBand = 100.0;
    static constexpr StepCost kCost{4.3, 2.0, 2.6};
    static constexpr double kDiagonal = 0.5;

    template <class System>
    static auto filter(const System& s) {
        return s.trapezoidal();
    }

    template <class Model, int W = Model::kWidth>
    struct alignas(64) Stages {
        static constexpr int kSize = Model::kMaxDegrees * W;
        double x[kSize], v[kSize], a_start[kSize], a_end[kSize];
        double input[2][2 * Model::kMaxSources * W];  // of the sensor, at the step's ends
        StageScratch<Model> meshes{};
    };

    template <class Model, int W = Model::kWidth>
    static GEARPOD_INLINE void step(const IntegrationPlan& plan, const typename Model::Lanes& lanes,
                                    const machine::AlignedVector& filter,
                                    const MeshOverrides& overrides, int i, TileState& state,
                                    Stages<Model>& s) {
        const Step& step = plan.grid.steps[static_cast<std::size_t>(i)];
        StageSpan<W> span;
        for (int l = 0; l < W; ++l) {
            span.a[l] = kDiagonal * step.length * lanes.mesh_period[l];
            span.b[l] = span.a[l] * span.a[l];
        }
        double* __restrict q = state.q.data();
        double* __restrict v = state.v.data();
        load_pairs<Model>(plan, lanes, overrides, i, 0, s.meshes.pairs);
        implicit_stage<Model>(lanes, lanes.block_at_rest(), StageSpan<W>{}, q, v, s.a_start,
                              s.meshes);
        Model::source_accelerations(lanes, q, v, s.a_start, s.input[0]);
        for (int j = 0; j < lanes.degrees * W; j += W) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                const double vj = std::fma(span.a[l], s.a_start[j + l], v[j + l]);
                s.v[j + l] = vj;
                s.x[j + l] = std::fma(span.a[l], v[j + l] + vj, q[j + l]);
            }
        }
        diagonal_stage<Model>(plan, lanes, overrides, i, 1, span, s.x, s.v, s.a_end, v, q,
                              s.input[1], s.meshes);
        // The method has no middle node; its coefficients are 0.
        step_filter<W>(filter, step, 2 * lanes.sources, state, s.input[0], s.input[0], s.input[1]);
    }
};

}  // namespace gearpod::lockstep
