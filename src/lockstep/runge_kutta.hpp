// Classical Runge-Kutta, explicit, order 4: q'' = a(q, q') with the stiffness at the step's start,
// middle and end. The sensor's low-pass is integrated beside the motion by the same method.
#pragma once

#include "lockstep/march_steps.hpp"

namespace gearpod::lockstep {

struct RungeKutta4 {
    // Scratch of one tile; small enough to stay in the first-level cache.
    template <class Model, int W = Model::kWidth>
    struct alignas(64) Stages {
        using Real = RealOf<Model>;
        Real q[Model::kMaxDegrees * W], v[Model::kMaxDegrees * W];
        Real a1[Model::kMaxDegrees * W], a2[Model::kMaxDegrees * W], a3[Model::kMaxDegrees * W];
        typename Model::Pairs pairs;
        Real input[3][2 * Model::kMaxSources * W];  // of the sensor, at the step's nodes
    };

    // The stage positions and velocities follow from the stage accelerations, so only those are
    // kept.
    template <class Model, class State, class Filter, int W = Model::kWidth>
    static GEARPOD_INLINE void step(const MarchPlan& plan, const typename Model::Lanes& lanes,
                                    const Filter& filter,
                                    const std::vector<PairOverride>& overrides, int i, State& state,
                                    Stages<Model>& s) {
        using Real = RealOf<Model>;
        const Step& step = plan.grid.steps[static_cast<std::size_t>(i)];
        const int channels = 2 * Model::sources(lanes);
        const int size = Model::degrees_of_freedom(lanes) * W;
        Real* __restrict q = state.q.data();
        Real* __restrict v = state.v.data();
        const auto q_rest = position_rest(state);
        const auto v_rest = velocity_rest(state);
        const Real length = static_cast<Real>(step.length);
        alignas(64) Real h[W], half[W], sixth[W];
        for (int l = 0; l < W; ++l) {
            h[l] = length * lanes.mesh_period[l];
            half[l] = Real(0.5) * h[l];
            sixth[l] = h[l] / Real(6);
        }

        load_pairs<Model>(plan, lanes, overrides, i, 0, s.pairs);
        Model::accelerations(lanes, q, v, s.pairs, s.a1);
        Model::source_accelerations(lanes, q, v, s.a1, s.input[0]);
        for (int j = 0; j < size; j += W) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                s.q[j + l] = std::fma(half[l], v[j + l], q[j + l]);
                s.v[j + l] = std::fma(half[l], s.a1[j + l], v[j + l]);
            }
        }
        load_pairs<Model>(plan, lanes, overrides, i, 1, s.pairs);
        Model::accelerations(lanes, s.q, s.v, s.pairs, s.a2);
        Model::source_accelerations(lanes, s.q, s.v, s.a2, s.input[1]);
        for (int j = 0; j < size; j += W) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                s.q[j + l] = std::fma(half[l], s.v[j + l], q[j + l]);
                s.v[j + l] = std::fma(half[l], s.a2[j + l], v[j + l]);
            }
        }
        Model::accelerations(lanes, s.q, s.v, s.pairs, s.a3);
        Model::source_accelerations(lanes, s.q, s.v, s.a3, s.input[2]);
        for (int j = 0; j < channels * W; j += W) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                s.input[1][j + l] = Real(0.5) * (s.input[1][j + l] + s.input[2][j + l]);
            }
        }
        for (int j = 0; j < size; j += W) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                const Real sum = s.a2[j + l] + s.a3[j + l];
                s.q[j + l] = std::fma(h[l], s.v[j + l], q[j + l]);
                s.v[j + l] = std::fma(h[l], s.a3[j + l], v[j + l]);
                // New position, and the part of the new velocity that is known before the last
                // stage.
                q[j + l] = advance(q[j + l], h[l], std::fma(sixth[l], s.a1[j + l] + sum, v[j + l]),
                                   q_rest, j + l);
                v[j + l] =
                    advance(v[j + l], sixth[l], std::fma(Real(2), sum, s.a1[j + l]), v_rest, j + l);
            }
        }
        load_pairs<Model>(plan, lanes, overrides, i, 2, s.pairs);
        Model::accelerations(lanes, s.q, s.v, s.pairs, s.a1);
        Model::source_accelerations(lanes, s.q, s.v, s.a1, s.input[2]);
        for (int j = 0; j < size; j += W) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                v[j + l] = advance(v[j + l], sixth[l], s.a1[j + l], v_rest, j + l);
            }
        }
        const Real* coefficients = filter.data() + step.kind * kFilterCoefficients * W;
        for (int channel = 0; channel < channels; ++channel) {
            const int at = channel * W;
            filter_channel<W>(coefficients, s.input[0] + at, s.input[1] + at, s.input[2] + at,
                              state.filter.data() + at * kFilterStates);
        }
    }
};

}  // namespace gearpod::lockstep
