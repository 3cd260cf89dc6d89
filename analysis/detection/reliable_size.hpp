// The size that a detector can be trusted with.
#pragma once

#include <optional>
#include <span>

#include "analysis/detection/detection.hpp"

namespace gearpod::analysis {

// Who can be trusted finds so many.
inline constexpr double kReliablePd = 0.9;

// The smallest tested fault size from which on, at all larger tested sizes too, the lower bound of
// Pd is at least `pd`. Empty if not reached. The healthy group (size 0) is no fault size.
std::optional<SizeGroup> reliable_size(const LevelDetection& level, double pd);

// How many found in a row, none missed, show a probability of `pd` at the confidence: 29 for 0.9 at
// 0.95, the classic demonstration (MIL-HDBK-1823A, section 4.5.2).
long hits_in_a_row(double pd, double confidence);

// The same from gearboxes one by one, `hit` 1 detected, 0 missed, -1 no value: the size of the
// last of so many in a row beyond the largest fault that was missed. Rows that reach down one
// gearbox at a time from the largest size are tests in an order fixed beforehand, which stop at the
// first that fails: the confidence holds for all together, if larger faults are not found less.
// NaN if there are too few.
double size_beyond_misses(std::span<const double> sizes, std::span<const int> hit, double pd,
                          double confidence);

// By groups (their intervals are two-sided) or one by one: the lesser of two sizes, each with half
// the chance of error. NaN if neither is reached.
double tested_size(const LevelDetection& level, std::span<const double> sizes,
                   std::span<const int> hit, double pd, double confidence);

}  // namespace gearpod::analysis
