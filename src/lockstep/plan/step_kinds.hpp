// The distinct lengths among a grid's steps.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace gearpod::lockstep {

// Transitions closer than this to a node, or to each other, share it: far below any step, far above
// the rounding of phases.
inline constexpr double kSamePhase = 1e-12;

// The place of a length among the known ones, to which it is added if it is new.
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
