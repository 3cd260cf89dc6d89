// Implicit methods of one stage: Newmark's, Chung and Hulbert's and the generalised alpha method.
#pragma once

#include <cmath>

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
    static constexpr ImplicitSpan kSpan{0.5, 0.25};

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
    static GEARPOD_INLINE void step(const IntegrationPlan& plan, const ImplicitLanes<W>& lanes,
                                    const machine::AlignedVector& filter,
                                    const MeshOverrides& overrides, int i, TileState& state,
                                    Stages<Model>& s) {
        const Step& step = plan.grid.steps[static_cast<std::size_t>(i)];
        StageSpan<W> span;
        for (int l = 0; l < W; ++l) {
            span.a[l] = 0.5 * step.length * lanes.mesh_period[l];
            span.b[l] = span.a[l] * span.a[l];
        }
        begin_trapezoid<Model>(plan, lanes, overrides, i, span, state, s.a_start, s.x, s.v,
                               s.input[0], s.meshes);
        diagonal_stage<Model>(plan, lanes, overrides, i, 1, span, s.x, s.v, s.a_end, state.v.data(),
                              state.q.data(), s.input[1], s.meshes);
        // The method has no middle node; its coefficients are 0.
        step_filter<W>(filter, step, 2 * lanes.sources, state, s.input[0], s.input[0], s.input[1]);
    }
};

// Generalized-alpha method (Chung and Hulbert, J. Appl. Mech. 60, 1993), order 2. The equation of
// motion uses forces at one time within the step and accelerations at another. Modes much faster
// than the step are thereby damped by a chosen factor. The method carries an acceleration from step
// to step. Where the stiffness jumps, it recomputes this from the equation of motion, so that the
// order survives contact transitions.

// True if the stiffness of any pair jumps at the start of a step, or if it is the first step. Only
// data shared by all lanes decide, so that a lane's bits do not depend on other lanes.
inline bool jumps(const IntegrationPlan& plan, int step) {
    if (step == 0) {
        return true;
    }
    constexpr double kRounding = 1e-9;
    const int pairs = plan.nodes.pairs;
    const int nodes = static_cast<int>(plan.grid.stage_nodes.size());
    const double* after = plan.nodes.stiffness.data() + step * nodes * pairs;
    const double* before = after - pairs;
    for (int pair = 0; pair < pairs; ++pair) {
        if (std::abs(after[pair] - before[pair]) > kRounding * after[pair]) {
            return true;
        }
    }
    return false;
}

// Coefficients of the method. rho is the factor by which one step multiplies modes much too fast
// for it: 1 preserves them as Newmark's method does, 0 removes them at once. With 0.8 an unresolved
// mode halves in three steps, and resolved modes are hardly damped. The carried acceleration
// belongs to a time `kLag` steps before the step's end.
struct ChungHulbert {
    static constexpr double kRho = 0.8;
    static constexpr double kMass = (2.0 * kRho - 1.0) / (kRho + 1.0);  // alpha_m
    static constexpr double kForce = kRho / (kRho + 1.0);               // alpha_f
    static constexpr double kGamma = 0.5 - kMass + kForce;
    static constexpr double kBeta = 0.25 * (1.0 - kMass + kForce) * (1.0 - kMass + kForce);
    static constexpr double kLag = kForce - kMass;
    static constexpr ImplicitSpan span() {
        constexpr double kPart = (1.0 - kForce) / (1.0 - kMass);
        return {kPart * kGamma, kPart * kBeta};
    }
};

struct GeneralizedAlpha {
    static constexpr const char* kName = "generalized-alpha";
    static constexpr int kOrder = 2;
    static constexpr double kStageNodes[] = {0.0, 1.0 - ChungHulbert::kForce, 1.0};
    static constexpr double kStepsInBand = 100.0;
    static constexpr StepCost kCost{2.4, 2.0, 1.4};
    static constexpr ImplicitSpan kSpan = ChungHulbert::span();

    // Trapezoidal rule with linear interpolation of the input between two times, kLag steps before
    // the step's ends.
    template <class System>
    static auto filter(const System& s) {
        constexpr double kLag = ChungHulbert::kLag;
        const auto ends = s.trapezoidal();
        auto map = ends;
        map.inputs.col(0) = (1.0 - kLag) * ends.inputs.col(0) - kLag * ends.inputs.col(2);
        map.inputs.col(2) = kLag * ends.inputs.col(0) + (1.0 + kLag) * ends.inputs.col(2);
        return map;
    }

    template <class Model, int W = Model::kWidth>
    struct alignas(64) Stages {
        static constexpr int kSize = Model::kMaxDegrees * W;
        // Stage values without the stage's own acceleration; afterwards, values at the time of the
        // carried acceleration.
        double x[kSize], v[kSize];
        double a[kSize], stage[kSize];                // carried from step to step; of the stage
        double input[2][2 * Model::kMaxSources * W];  // of the sensor
        StageScratch<Model> meshes{};
    };

    template <class Model, int W = Model::kWidth>
    static GEARPOD_INLINE void step(const IntegrationPlan& plan, const ImplicitLanes<W>& lanes,
                                    const machine::AlignedVector& filter,
                                    const MeshOverrides& overrides, int i, TileState& state,
                                    Stages<Model>& s) {
        using C = ChungHulbert;
        // Weights of the carried acceleration in the stage's V and Q, and of both accelerations in
        // the update.
        constexpr double kPart = 1.0 - C::kForce;
        constexpr double kOld = C::kMass / (1.0 - C::kMass), kNew = 1.0 / (1.0 - C::kMass);
        constexpr double kInV = kPart * (1.0 - C::kGamma - C::kGamma * kOld);
        constexpr double kInX = kPart * (0.5 - C::kBeta - C::kBeta * kOld);
        constexpr ImplicitSpan kOwn = C::span();
        const Step& step = plan.grid.steps[static_cast<std::size_t>(i)];
        const int size = lanes.degrees * W;
        double* __restrict q = state.q.data();
        double* __restrict v = state.v.data();
        alignas(64) double h[W];
        StageSpan<W> span;
        for (int l = 0; l < W; ++l) {
            h[l] = step.length * lanes.mesh_period[l];
            span.a[l] = kOwn.velocity * h[l];
            span.b[l] = kOwn.position * h[l] * h[l];
        }
        if (jumps(plan, i)) {
            load_pairs<Model>(plan, lanes, overrides, i, 0, s.meshes.pairs);
            implicit_stage<Model>(lanes, lanes.block_at_rest(), StageSpan<W>{}, q, v, s.a,
                                  s.meshes);
            Model::source_accelerations(lanes, q, v, s.a, s.input[1]);
        }
        std::copy_n(s.input[1], 2 * lanes.sources * W, s.input[0]);
        for (int j = 0; j < size; j += W) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                const double rise = h[l] * s.a[j + l];
                s.v[j + l] = std::fma(kInV, rise, v[j + l]);
                s.x[j + l] = std::fma(h[l], std::fma(kInX, rise, kPart * v[j + l]), q[j + l]);
            }
        }
        load_pairs<Model>(plan, lanes, overrides, i, 1, s.meshes.pairs);
        implicit_stage<Model>(lanes, lanes.block(step.kind), span, s.x, s.v, s.stage, s.meshes);
        for (int j = 0; j < size; j += W) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                const double before = s.a[j + l];
                const double after = std::fma(kNew, s.stage[j + l], -kOld * before);
                const double rise = std::fma(0.5 - C::kBeta, before, C::kBeta * after);
                q[j + l] = std::fma(h[l], std::fma(h[l], rise, v[j + l]), q[j + l]);
                v[j + l] =
                    std::fma(h[l], std::fma(1.0 - C::kGamma, before, C::kGamma * after), v[j + l]);
                s.a[j + l] = after;
                s.v[j + l] = std::fma(-C::kLag * h[l], after, v[j + l]);
                s.x[j + l] = std::fma(-C::kLag * h[l], v[j + l], q[j + l]);
            }
        }
        Model::source_accelerations(lanes, s.x, s.v, s.a, s.input[1]);
        // The method has no middle node; its coefficients are 0.
        step_filter<W>(filter, step, 2 * lanes.sources, state, s.input[0], s.input[0], s.input[1]);
    }
};

}  // namespace gearpod::lockstep
