// State that a kernel advances within a mesh period: in double precision the tile's state itself,
// in single precision a copy of it.
//
// Single precision represents a position by a float and its rounding error (compensated summation,
// Kahan 1965). A step changes a position by a relative 1e-4 or less, and thousands of such changes
// would be lost in a float's 6e-8. Velocities need no compensation. Rounding one is equivalent to
// an acceleration of 6e-8 v / h, 1e-5 of those at the sensor, and dampers remove its effect. The
// filter's states need none either, because each step recomputes them.
#pragma once

#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "lockstep/plan/integration_plan.hpp"
#include "machine/instruction_sets.hpp"

namespace gearpod::lockstep {

// Floating-point type of a model's kernels.
template <class Model>
using RealOf = std::remove_all_extents_t<decltype(std::declval<typename Model::Pairs>().k)>;

struct SingleState {
    machine::AlignedArray<float> q, v, filter;
    machine::AlignedArray<float> q_rounding;

    explicit SingleState(const TileState& state)
        : q(state.q.begin(), state.q.end()),
          v(state.v.begin(), state.v.end()),
          filter(state.filter.begin(), state.filter.end()),
          q_rounding(q.size()) {
        for (std::size_t i = 0; i < q.size(); ++i) {
            q_rounding[i] = static_cast<float>(state.q[i] - double{q[i]});
        }
    }

    void copy_to(TileState& state) const {
        for (std::size_t i = 0; i < q.size(); ++i) {
            state.q[i] = double{q[i]} + double{q_rounding[i]};
        }
        state.v.assign(v.begin(), v.end());
        state.filter.assign(filter.begin(), filter.end());
    }
};

// Rounding errors of a state's positions; none in double precision.
struct NoRounding {};
GEARPOD_INLINE NoRounding position_rounding(TileState&) {
    return {};
}
GEARPOD_INLINE float* position_rounding(SingleState& state) {
    return state.q_rounding.data();
}

// Returns sum + h rate, compensated for single precision; `i` is the index of the sum in `rest`.
GEARPOD_INLINE double advance(double sum, double h, double rate, NoRounding, int) {
    return std::fma(h, rate, sum);
}
GEARPOD_INLINE float advance(float sum, float h, float rate, float* __restrict rest, int i) {
    const float change = std::fma(h, rate, rest[i]);
    const float next = sum + change;
    rest[i] = change - (next - sum);
    return next;
}

GEARPOD_INLINE double position(const TileState& state, int i) {
    return state.q[static_cast<std::size_t>(i)];
}
GEARPOD_INLINE double position(const SingleState& state, int i) {
    const auto index = static_cast<std::size_t>(i);
    return double{state.q[index]} + double{state.q_rounding[index]};
}

// States at the ends of the steps of a mesh period, recorded on request.

// Fraction of a step by which an integrator's positions are ahead of its velocities, between steps
// without a sample.
template <class Integrator>
constexpr double position_lead() {
    if constexpr (requires { Integrator::kPositionLead; }) {
        return Integrator::kPositionLead;
    }
    return 0.0;
}

// Writes row `step` of MeshRecord::step_states: the state at the start of that step, or after the
// last one.
template <class Integrator, class Model, class State, int W = Model::kWidth>
GEARPOD_INLINE void write_step_state(const IntegrationPlan& plan,
                                     const typename Model::Lanes& lanes, int step,
                                     const State& state, MeshRecord& record) {
    const int size = static_cast<int>(plan.te_weight.size()) * W;
    double* __restrict q = record.step_states.data() + 2 * step * size;
    double* __restrict v = q + size;
    const auto row = static_cast<std::size_t>(step);
    const bool parted =
        step == 0 || row == plan.grid.steps.size() || plan.grid.steps[row].sample >= 0;
    const double ahead = parted ? 0.0 : position_lead<Integrator>() * plan.grid.steps[row].length;
    for (int i = 0; i < size; ++i) {
        v[i] = double{state.v[static_cast<std::size_t>(i)]};
        q[i] = position(state, i) - ahead * double{lanes.mesh_period[i % W]} * v[i];
    }
}

}  // namespace gearpod::lockstep
