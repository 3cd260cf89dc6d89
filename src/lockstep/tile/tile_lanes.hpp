// Access to single lanes of a tile's arrays, whose last index is the lane.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "lockstep/plan/integration_plan.hpp"

namespace gearpod::lockstep {

template <int W>
using LaneMask = std::array<bool, W>;

// Sets all values of a lane (indices lane, lane + W, ...).
template <int W>
void fill_lane(machine::AlignedVector& values, int lane, double value) {
    for (std::size_t i = static_cast<std::size_t>(lane); i < values.size(); i += W) {
        values[i] = value;
    }
}

template <int W>
double largest(const machine::AlignedVector& values, int lane) {
    double result = 0.0;
    for (std::size_t i = static_cast<std::size_t>(lane); i < values.size(); i += W) {
        result = std::isfinite(values[i]) ? std::max(result, std::abs(values[i])) : INFINITY;
    }
    return result;
}

template <int W>
double largest_difference(const machine::AlignedVector& a, const machine::AlignedVector& b,
                          int lane) {
    double result = 0.0;
    for (std::size_t i = static_cast<std::size_t>(lane); i < a.size(); i += W) {
        result = std::max(result, std::abs(a[i] - b[i]));
    }
    return result;
}

template <int W>
void copy_lanes(const machine::AlignedVector& from, machine::AlignedVector& to,
                const LaneMask<W>& lanes) {
    for (std::size_t row = 0; row < to.size(); row += W) {
        for (std::size_t l = 0; l < W; ++l) {
            to[row + l] = lanes[l] ? from[row + l] : to[row + l];
        }
    }
}

// Copies what `to` holds; `from` may hold the motion in addition.
template <int W>
void copy_lanes(const MeshRecord& from, MeshRecord& to, const LaneMask<W>& lanes) {
    copy_lanes<W>(from.acceleration, to.acceleration, lanes);
    copy_lanes<W>(from.te, to.te, lanes);
    copy_lanes<W>(from.motion, to.motion, lanes);
    copy_lanes<W>(from.mesh_force, to.mesh_force, lanes);
}

template <int W>
void copy_lanes(const TileState& from, TileState& to, const LaneMask<W>& lanes) {
    copy_lanes<W>(from.q, to.q, lanes);
    copy_lanes<W>(from.v, to.v, lanes);
    copy_lanes<W>(from.filter, to.filter, lanes);
}

}  // namespace gearpod::lockstep
