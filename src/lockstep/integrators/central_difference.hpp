// Central difference method, explicit, order 2, one evaluation per step at its midpoint
// (Stoermer-Verlet in drift-kick-drift form; Hairer, Lubich and Wanner, Acta Numerica 2003):
//     x = q + h/2 q',   a = a(x, u),   q' += h a,   q = x + h/2 q'.
// The velocity u for dampers and the rotating frame should be q' + h/2 a. The method uses the
// previous step's acceleration instead: u = q' + w / h with w = h^2/2 a of that step. The first
// step of a mesh period uses its own acceleration, from a second evaluation. The impulses of the
// dampers are thus one step late, but none is lost, even where steps of different lengths meet at a
// contact transition. A step uses only the stiffness inside itself, so jumps between steps do not
// reduce the order.
#pragma once

#include "lockstep/integrators/explicit_stage.hpp"

namespace gearpod::lockstep {

struct CentralDifference {
    static constexpr const char* kName = "central-difference";
    static constexpr int kOrder = 2;
    static constexpr double kStageNodes[] = {0.5};
    // Relative error of the low-pass filter there: (2 pi / steps)^2 / 12, or 7e-4; 3e-3 with half
    // as many steps.
    static constexpr double kStepsInBand = 70.0;
    static constexpr StepCost kCost{0.32, 0.34, 0.34};
    static constexpr double kLeastMargin = 1.04;
    static constexpr bool kScalesMass = true;
    // Between steps without a sample, positions have already drifted to the midpoint of the next
    // step. They are then ahead of the velocities by this fraction of its length.
    static constexpr double kPositionLead = 0.5;

    // M - h C - h^2/4 (K + K_c) must be positive definite. At the limit, a motion changes sign at
    // every step without decaying. It has q = 0 at the steps' ends and h/2 q' at their midpoints,
    // where the velocity from the previous step's acceleration is doubled. For one mode: omega h =
    // 2 (sqrt(1 + 4 zeta^2) - 2 zeta). Gyroscopic forces do no work on it and have no influence.
    static double stable_step(const dynamics::GearboxMatrices& matrices);

    // Trapezoidal rule with the input at the step's midpoint only.
    template <class System>
    static auto filter(const System& s) {
        auto map = s.trapezoidal();
        map.inputs.col(0) *= 2.0;
        map.inputs.col(2).setZero();
        return map;
    }

    // s.v is u. Between two steps without a sample, state.q is at the midpoint of the second.
    template <class Model>
    using Stages = ExplicitStages<Model, 1>;

    template <class Model, class State, class Filter, int W = Model::kWidth>
    static GEARPOD_INLINE void step(const IntegrationPlan& plan, const typename Model::Lanes& lanes,
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
                    x.q[j + l] = advance(x.q[j + l], x.half[l], x.v[j + l], x.q_rounding, j + l);
                }
            }
        }
        load_pairs<Model>(plan, lanes, overrides, i, 0, s.pairs);
        for (bool again = i == 0;; again = false) {
            Model::accelerations(lanes, x.q, s.v, s.pairs, a);
            if (plan.mode_inertia.blocks > 0) {
                scale_mass<W>(plan.mode_inertia, x.size, a);
            }
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
        const DriftTimes<Real, W> drift_times(plan, i, lanes.mesh_period, x.half);
        for (int j = 0; j < x.size; j += W) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                const int index = j + l;
                const Real v = std::fma(x.h[l], a[index], x.v[index]);
                x.v[index] = v;
                x.q[index] = advance(x.q[index], drift_times.drift[l], v, x.q_rounding, index);
                s.v[index] = std::fma(drift_times.reach[l], a[index], v);
            }
        }
        step_filter<W>(filter, x.step, x.channels, state, s.input[0]);
    }

  private:
    // Accelerations with the additional inertia of fast modes, from those without it.
    template <int W, class Real>
    static GEARPOD_INLINE void scale_mass(const ModeInertia& inertia, int size,
                                          Real* __restrict a) {
        constexpr int kModes = kModesPerBlock;
        const ModeTables<Real>& tables = inertia.tables<Real>();
        for (int block = 0; block < inertia.blocks; ++block) {
            const int first = block * size / W * kModes;
            const Real* __restrict momentum = tables.momentum.data() + first;
            const Real* __restrict effect = tables.effect.data() + first;
            alignas(64) Real sum[kModes * W] = {};
            for (int j = 0; j < size; j += W, momentum += kModes) {
                for (int k = 0; k < kModes; ++k) {
#pragma omp simd
                    for (int l = 0; l < W; ++l) {
                        sum[k * W + l] = std::fma(momentum[k], a[j + l], sum[k * W + l]);
                    }
                }
            }
            for (int j = 0; j < size; j += W, effect += kModes) {
                for (int k = 0; k < kModes; ++k) {
#pragma omp simd
                    for (int l = 0; l < W; ++l) {
                        a[j + l] = std::fma(effect[k], sum[k * W + l], a[j + l]);
                    }
                }
            }
        }
    }

    // Times in seconds: `drift` from a step's midpoint to its end, or on to the next midpoint;
    // `reach` from the end velocity to the next u.
    template <class Real, int W>
    struct DriftTimes {
        alignas(64) Real drift[W], reach[W];

        GEARPOD_INLINE DriftTimes(const IntegrationPlan& plan, int i, const Real* period,
                                  const Real* half) {
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
