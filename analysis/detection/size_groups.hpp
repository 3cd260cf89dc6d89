// Which size group a gearbox belongs to, and what its group counts.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "analysis/detection/detection_table.hpp"

namespace gearpod::analysis {

inline constexpr std::size_t kNoGroup = static_cast<std::size_t>(-1);

// A fixed level takes its own size (up to a unit conversion's rounding). A range takes its lower
// edge and leaves the upper one to the next group, unless no group begins there.
std::optional<std::size_t> group_of(double size, const std::vector<SizeGroup>& groups);
// The same for every gearbox, kNoGroup for none.
std::vector<std::size_t> groups_of(std::span<const double> sizes,
                                   const std::vector<SizeGroup>& groups);

// Adds one gearbox; a value that is not finite counts as failed.
void count(DetectionCell& cell, double value, double threshold, Alarm alarm);

// Sets the rate and its bounds from the counts; NaN if none was tested or without a threshold.
void rate(DetectionCell& cell, bool has_threshold, double confidence);

}  // namespace gearpod::analysis
