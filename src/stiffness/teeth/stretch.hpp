// Stretches of the position axis between transitions (phases in [0, 1), repeated every mesh period)
// and jumps (positions that do not repeat).
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

namespace gearpod::stiffness {

struct Stretch {
    double begin = 0, end = 0;
};

// Stretch around a position that lies strictly within it. transitions must not be empty.
inline Stretch stretch_around(std::span<const double> transitions, std::span<const double> jumps,
                              double inside) {
    const double period = std::floor(inside);
    const auto next = std::upper_bound(transitions.begin(), transitions.end(), inside - period);
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
