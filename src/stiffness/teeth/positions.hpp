// Range of ascending positions that lie within an interval.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "machine/contracts.hpp"

namespace gearpod::stiffness {

// Tolerance of positions, mesh periods. Positions this close to the end of an engagement count as
// inside. A phase reduced from thousands of meshes has a rounding error of that order.
inline constexpr double kPositionTolerance = 1e-10;

// Sorts positions in ascending order and removes duplicates.
inline void sort_positions(std::vector<double>& positions) {
    std::ranges::sort(positions);
    positions.erase(std::unique(positions.begin(), positions.end(),
                                [](double a, double b) { return b - a < kPositionTolerance; }),
                    positions.end());
}

struct PositionRange {
    std::size_t first = 0, count = 0;
};

// True if positions ascend. Nodes of neighbouring steps that coincide may differ by rounding.
inline bool ascend(std::span<const double> positions) {
    return std::ranges::is_sorted(positions,
                                  [](double a, double b) { return a < b - kPositionTolerance; });
}

// The positions ascend. Callers check it once for all their intervals.
inline PositionRange positions_within(std::span<const double> ascending, double begin, double end) {
    const auto low = std::ranges::lower_bound(ascending, begin - kPositionTolerance);
    const auto high = std::upper_bound(low, ascending.end(), end + kPositionTolerance);
    return {static_cast<std::size_t>(low - ascending.begin()),
            static_cast<std::size_t>(high - low)};
}

// Stretches of the position axis between transitions (phases in [0, 1), repeated every mesh period)
// and jumps (positions that do not repeat).
struct Stretch {
    double begin = 0, end = 0;
};

// Stretch around a position that lies strictly within it.
inline Stretch stretch_around(std::span<const double> transitions, std::span<const double> jumps,
                              double inside) {
    EXPECTS(!transitions.empty());
    const double period = std::floor(inside);
    const auto next = std::ranges::upper_bound(transitions, inside - period);
    Stretch stretch;
    stretch.begin =
        next == transitions.begin() ? period - 1 + transitions.back() : period + *(next - 1);
    stretch.end = next == transitions.end() ? period + 1 + transitions.front() : period + *next;
    for (const double jump : jumps) {
        if (jump <= inside)
            stretch.begin = std::max(stretch.begin, jump);
        else
            stretch.end = std::min(stretch.end, jump);
    }
    return stretch;
}

}  // namespace gearpod::stiffness
