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
#include "machine/dispatch.hpp"

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
    const auto at = static_cast<std::size_t>(i);
    return double{state.q[at]} + double{state.q_rounding[at]};
}

}  // namespace gearpod::lockstep
