// Which group a fault size belongs to.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "analysis/detection.hpp"

namespace gearpod::analysis {

// A fixed level takes its own size (up to a unit conversion's rounding). A range takes its lower
// edge and leaves the upper one to the next group, unless no group begins there.
std::optional<std::size_t> group_of(double size, const std::vector<SizeGroup>& groups);

}  // namespace gearpod::analysis
