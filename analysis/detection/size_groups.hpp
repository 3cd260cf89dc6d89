// Assignment of gearboxes to size groups, and the counts of a group.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "analysis/detection/detection_table.hpp"

namespace gearpod::analysis {

inline constexpr std::size_t kNoGroup = static_cast<std::size_t>(-1);

// Group of a size. A fixed level holds its own size up to the rounding of a unit conversion. A
// range holds its lower edge; its upper edge belongs to the next group, unless no group begins
// there.
std::optional<std::size_t> group_of(double size, const std::vector<SizeGroup>& groups);
// Group of every gearbox; kNoGroup for none.
std::vector<std::size_t> groups_of(std::span<const double> sizes,
                                   const std::vector<SizeGroup>& groups);

// Adds one gearbox. A value that is not finite counts as failed.
void count(DetectionCell& cell, double value, double threshold, Alarm alarm);

// Sets the rate and its bounds from the counts; NaN if none was tested or without a threshold.
void rate(DetectionCell& cell, bool has_threshold, double confidence);

}  // namespace gearpod::analysis
