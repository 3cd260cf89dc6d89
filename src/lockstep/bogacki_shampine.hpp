// The pair of Bogacki and Shampine (1989), explicit, orders 3 and 2: three stages make the step of
// order 3; a fourth, at its end, tells how far the embedded one of order 2 lies from it. That stage
// would be the next step's first but for the jumps of stiffness, so it is left out of the march:
// only a plan whose stage nodes include 1 asks for the estimate (a pilot, step_pilot.hpp).
#pragma once

#include "lockstep/march_steps.hpp"

namespace gearpod::lockstep {

struct BogackiShampine {
    static constexpr std::size_t kEstimateNode = 3;  // place of node 1 among the stage nodes

    template <class Model, int W = Model::kWidth>
    struct alignas(64) Stages {
        using Real = RealOf<Model>;
        Real q[Model::kMaxDegrees * W], v[Model::kMaxDegrees * W];
        Real a1[Model::kMaxDegrees * W], a2[Model::kMaxDegrees * W], a3[Model::kMaxDegrees * W];
        typename Model::Pairs pairs;
        Real input[3][2 * Model::kMaxSources * W];  // of the sensor, at the three stages
        Real estimate[kEstimateRows * W] = {};      // see MeshRecord::estimate
    };

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
        alignas(64) Real h[W], half[W], most[W], ninth[W], sixth[W];
        for (int l = 0; l < W; ++l) {
            h[l] = length * lanes.mesh_period[l];
            half[l] = Real(0.5) * h[l];
            most[l] = Real(0.75) * h[l];
            ninth[l] = h[l] / Real(9);
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
                s.q[j + l] = std::fma(most[l], s.v[j + l], q[j + l]);
                s.v[j + l] = std::fma(most[l], s.a2[j + l], v[j + l]);
            }
        }
        load_pairs<Model>(plan, lanes, overrides, i, 2, s.pairs);
        Model::accelerations(lanes, s.q, s.v, s.pairs, s.a3);
        Model::source_accelerations(lanes, s.q, s.v, s.a3, s.input[2]);
        if (plan.grid.stage_nodes.size() > kEstimateNode) {
            estimate<Model>(plan, lanes, overrides, i, h, q, v, s);
        }
        for (int j = 0; j < size; j += W) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                // 2/9, 3/9 and 4/9 of the stages' slopes; the velocities' follow from a1 and a2.
                const Real slope =
                    std::fma(sixth[l], std::fma(Real(2), s.a2[j + l], s.a1[j + l]), v[j + l]);
                const Real rise = std::fma(Real(2), s.a1[j + l],
                                           std::fma(Real(3), s.a2[j + l], Real(4) * s.a3[j + l]));
                q[j + l] = advance(q[j + l], h[l], slope, q_rest, j + l);
                v[j + l] = advance(v[j + l], ninth[l], rise, v_rest, j + l);
            }
        }
        const Real* coefficients = filter.data() + step.kind * kFilterCoefficients * W;
        for (int channel = 0; channel < channels; ++channel) {
            const int at = channel * W;
            filter_channel<W>(coefficients, s.input[0] + at, s.input[1] + at, s.input[2] + at,
                              state.filter.data() + at * kFilterStates);
        }
    }

  private:
    // From q and v at the step's start and the three stages: how far orders 3 and 2 lie apart. Uses
    // up s.q and s.v.
    template <class Model, class Real, int W = Model::kWidth>
    static GEARPOD_INLINE void estimate(const MarchPlan& plan, const typename Model::Lanes& lanes,
                                        const std::vector<PairOverride>& overrides, int i,
                                        const Real* h, const Real* q, const Real* v,
                                        Stages<Model>& s) {
        const int size = Model::degrees_of_freedom(lanes) * W;
        Real end_q[Model::kMaxDegrees * W], end_v[Model::kMaxDegrees * W],
            a4[Model::kMaxDegrees * W];
        for (int j = 0; j < size; ++j) {
            const Real t = h[j % W];
            end_q[j] = q[j] + t * (v[j] + t / Real(6) * (s.a1[j] + Real(2) * s.a2[j]));
            end_v[j] =
                v[j] + t / Real(9) * (Real(2) * s.a1[j] + Real(3) * s.a2[j] + Real(4) * s.a3[j]);
        }
        load_pairs<Model>(plan, lanes, overrides, i, static_cast<int>(kEstimateNode), s.pairs);
        Model::accelerations(lanes, end_q, end_v, s.pairs, a4);
        std::fill_n(s.estimate, kEstimateRows * W, Real(0));
        const auto keep_largest = [&s](int row, int lane, Real value) {
            Real& largest = s.estimate[row * W + lane];
            largest = std::abs(value) > largest ? std::abs(value) : largest;
        };
        for (int j = 0; j < size; ++j) {
            const int l = j % W;
            const Real v2 = v[j] + Real(0.5) * h[l] * s.a1[j];
            const Real v3 = v[j] + Real(0.75) * h[l] * s.a2[j];
            keep_largest(0, l, end_q[j]);
            keep_largest(1, l, end_v[j]);
            keep_largest(2, l,
                         h[l] / Real(72) *
                             (Real(6) * v2 + Real(8) * v3 - Real(5) * v[j] - Real(9) * end_v[j]));
            keep_largest(
                3, l,
                h[l] / Real(72) *
                    (Real(6) * s.a2[j] + Real(8) * s.a3[j] - Real(5) * s.a1[j] - Real(9) * a4[j]));
        }
    }
};

}  // namespace gearpod::lockstep
