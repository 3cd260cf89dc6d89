// Alexander's L-stable, stiffly accurate Runge-Kutta method of order 3 with one diagonal
// coefficient (SIAM J. Numer. Anal. 14, 1977). It has three implicit stages, the last at the step's
// end. No stage lies on the step's start, so a stiffness jump there needs no special treatment.
#pragma once

#include "lockstep/integrators/implicit_stage.hpp"
#include "lockstep/integrators/integration_steps.hpp"

namespace gearpod::lockstep {

// Coefficients of the method. Every stage has the same diagonal coefficient, a root of x^3 - 3 x^2
// + 3/2 x - 1/6; the last stage is the end of the step.
struct Alexander {
    static constexpr double kDiagonal = 0.43586652150845899942;
    static constexpr double kSecond = (1.0 + kDiagonal) / 2.0;  // node of the second stage
    static constexpr double k21 = (1.0 - kDiagonal) / 2.0;
    static constexpr double k31 = -(6.0 * kDiagonal * kDiagonal - 16.0 * kDiagonal + 1.0) / 4.0;
    static constexpr double k32 = (6.0 * kDiagonal * kDiagonal - 20.0 * kDiagonal + 5.0) / 4.0;
};

struct Sdirk3 {
    static constexpr const char* kName = "sdirk3";
    static constexpr int kOrder = 3;
    static constexpr double kStageNodes[] = {Alexander::kDiagonal, Alexander::kSecond, 1.0};
    static constexpr double kStepsInBand = 25.0;
    static constexpr StepCost kCost{6.8, 4.0, 4.2};
    static constexpr double kDiagonal = Alexander::kDiagonal;

    template <class System>
    static auto filter(const System& s) {
        const auto solve = (s.one() - Alexander::kDiagonal * s.a).inverse().eval();
        const auto slope = [&](const auto& from, int node) {
            return (solve * s.slope(from, node)).eval();
        };
        const auto z = s.start();
        const auto k1 = slope(z, 0);
        const auto k2 = slope(z + Alexander::k21 * k1, 1);
        const auto third = (z + Alexander::k31 * k1 + Alexander::k32 * k2).eval();
        return s.map(third + Alexander::kDiagonal * slope(third, 2));
    }

    template <class Model, int W = Model::kWidth>
    struct alignas(64) Stages {
        static constexpr int kSize = Model::kMaxDegrees * W;
        double x[kSize], v[kSize];  // of the stage, without its own acceleration
        double q_end[kSize];        // positions with it
        double v1[kSize], v2[kSize], v3[kSize], a1[kSize], a2[kSize], a3[kSize];
        double input[3][2 * Model::kMaxSources * W];  // of the sensor, at the stages
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
        alignas(64) double h21[W], h31[W], h32[W];
        for (int l = 0; l < W; ++l) {
            const double h = step.length * lanes.mesh_period[l];
            span.a[l] = Alexander::kDiagonal * h;
            span.b[l] = a[l] * a[l];
            h21[l] = Alexander::k21 * h;
            h31[l] = Alexander::k31 * h;
            h32[l] = Alexander::k32 * h;
        }
        for (int j = 0; j < size; j += W) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                s.v[j + l] = v[j + l];
                s.x[j + l] = std::fma(a[l], v[j + l], q[j + l]);
            }
        }
        diagonal_stage<Model>(plan, lanes, overrides, i, 0, span, s.x, s.v, s.a1, s.v1, s.q_end,
                              s.input[0], s.meshes);
        for (int j = 0; j < size; j += W) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                const double vj = std::fma(h21[l], s.a1[j + l], v[j + l]);
                const double qj = std::fma(h21[l], s.v1[j + l], q[j + l]);
                s.v[j + l] = vj;
                s.x[j + l] = std::fma(a[l], vj, qj);
            }
        }
        diagonal_stage<Model>(plan, lanes, overrides, i, 1, span, s.x, s.v, s.a2, s.v2, s.q_end,
                              s.input[1], s.meshes);
        for (int j = 0; j < size; j += W) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                const double vj =
                    std::fma(h32[l], s.a2[j + l], std::fma(h31[l], s.a1[j + l], v[j + l]));
                const double qj =
                    std::fma(h32[l], s.v2[j + l], std::fma(h31[l], s.v1[j + l], q[j + l]));
                s.v[j + l] = vj;
                s.x[j + l] = std::fma(a[l], vj, qj);
            }
        }
        diagonal_stage<Model>(plan, lanes, overrides, i, 2, span, s.x, s.v, s.a3, s.v3, s.q_end,
                              s.input[2], s.meshes);
        std::copy_n(s.q_end, size, q);
        std::copy_n(s.v3, size, v);

        step_filter<W>(filter, step, 2 * lanes.sources, state, s.input[0], s.input[1], s.input[2]);
    }
};

}  // namespace gearpod::lockstep
