// Composite method of Bathe and Baig (Comput. Struct. 83, 2005), implicit, order 2: the trapezoidal
// rule over a first part of the step, then Euler's three-point backward formula over the whole of
// it. Modes that the steps cannot resolve are removed at once, and resolved ones are hardly damped.
// With the first part 2 - sqrt(2) of the step, both substeps have the same matrix (Bathe, Comput.
// Struct. 85, 2007), and the method is L-stable TR-BDF2 (Bank et al., IEEE Trans. Electron Devices
// 32, 1985). The acceleration at a step's start is recomputed with the stiffness just after it, so
// that the order survives the jumps at contact transitions.
#pragma once

#include <numbers>

#include "lockstep/integrators/implicit_stage.hpp"
#include "lockstep/integrators/integration_steps.hpp"

namespace gearpod::lockstep {

struct Bathe {
    static constexpr double kFirstPart = 2.0 - std::numbers::sqrt2;
    // Factor of a substep's own slope, times the step.
    static constexpr double kDiagonal = 0.5 * kFirstPart;
    // Weight in the backward formula of the change over the first part.
    static constexpr double kChange = 1.0 / (kFirstPart * (2.0 - kFirstPart));

    static constexpr const char* kName = "bathe";
    static constexpr int kOrder = 2;
    static constexpr double kStageNodes[] = {0.0, kFirstPart, 1.0};
    // The leading error is 0.49 of the trapezoidal rule's.
    static constexpr double kStepsInBand = 70.0;
    // Estimated from those of newmark and sdirk3, which consist of the same stages.
    static constexpr StepCost kCost{6.6, 3.4, 4.0};
    static constexpr bool kNeverChosen = true;
    static constexpr ImplicitSpan kSpan{kDiagonal, kDiagonal* kDiagonal};

    template <class System>
    static auto filter(const System& s) {
        const auto solve = (s.one() - kDiagonal * s.a).inverse().eval();
        const auto substep = [&](const auto& from, int node) {
            return (from + kDiagonal * (solve * s.slope(from, node))).eval();
        };
        const auto z = s.start();
        const auto middle = substep((z + kDiagonal * s.slope(z, 0)).eval(), 1);
        return s.map(substep((z + kChange * (middle - z)).eval(), 2));
    }

    template <class Model, int W = Model::kWidth>
    struct alignas(64) Stages {
        static constexpr int kSize = Model::kMaxDegrees * W;
        double x[kSize], v[kSize];  // of the substep, without its own acceleration
        double q_middle[kSize], v_middle[kSize], a[kSize];
        double input[3][2 * Model::kMaxSources * W];  // of the sensor, at the nodes
        StageScratch<Model> meshes{};
    };

    template <class Model, int W = Model::kWidth>
    static GEARPOD_INLINE void step(const IntegrationPlan& plan, const typename Model::Lanes& lanes,
                                    const machine::AlignedVector& filter,
                                    const MeshOverrides& overrides, int i, TileState& state,
                                    Stages<Model>& s) {
        const Step& step = plan.grid.steps[static_cast<std::size_t>(i)];
        const int size = lanes.degrees * W;
        double* __restrict q = state.q.data();
        double* __restrict v = state.v.data();
        StageSpan<W> span;
        const double* const a = span.a;
        for (int l = 0; l < W; ++l) {
            span.a[l] = kDiagonal * step.length * lanes.mesh_period[l];
            span.b[l] = a[l] * a[l];
        }
        begin_trapezoid<Model>(plan, lanes, overrides, i, span, state, s.a, s.x, s.v, s.input[0],
                               s.meshes);
        diagonal_stage<Model>(plan, lanes, overrides, i, 1, span, s.x, s.v, s.a, s.v_middle,
                              s.q_middle, s.input[1], s.meshes);
        for (int j = 0; j < size; j += W) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                const double vj = std::fma(kChange, s.v_middle[j + l] - v[j + l], v[j + l]);
                const double qj = std::fma(kChange, s.q_middle[j + l] - q[j + l], q[j + l]);
                s.v[j + l] = vj;
                s.x[j + l] = std::fma(a[l], vj, qj);
            }
        }
        diagonal_stage<Model>(plan, lanes, overrides, i, 2, span, s.x, s.v, s.a, v, q, s.input[2],
                              s.meshes);
        step_filter<W>(filter, step, 2 * lanes.sources, state, s.input[0], s.input[1], s.input[2]);
    }
};

}  // namespace gearpod::lockstep
