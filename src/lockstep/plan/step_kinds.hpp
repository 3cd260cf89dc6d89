// Distinct step lengths of a grid.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace gearpod::lockstep {

// Phase tolerance, mesh periods: closer transitions share a node. It is far below any step length
// and far above the rounding error of phases.
inline constexpr double kSamePhase = 1e-12;

// Index of `length` in `lengths`; appends it if it is new.
inline int find_or_add(std::vector<double>& lengths, double length) {
    const auto found = std::find_if(lengths.begin(), lengths.end(), [&](double known) {
        return std::abs(known - length) < kSamePhase;
    });
    if (found != lengths.end()) {
        return static_cast<int>(found - lengths.begin());
    }
    lengths.push_back(length);
    return static_cast<int>(lengths.size()) - 1;
}

}  // namespace gearpod::lockstep
