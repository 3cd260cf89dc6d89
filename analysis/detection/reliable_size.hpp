// The size that a detector can be trusted with.
#pragma once

#include <optional>

#include "analysis/detection/detection.hpp"

namespace gearpod::analysis {

// Who can be trusted finds so many.
inline constexpr double kReliablePd = 0.9;

// The smallest tested fault size from which on, at all larger tested sizes too, the lower bound of
// Pd is at least `pd`. Empty if not reached. The healthy group (size 0) is no fault size.
std::optional<SizeGroup> reliable_size(const LevelDetection& level, double pd);

}  // namespace gearpod::analysis
