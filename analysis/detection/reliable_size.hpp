// Smallest fault size that a detector finds reliably, demonstrated by tests without a curve.
#pragma once

#include <optional>
#include <span>

#include "analysis/detection/detection.hpp"

namespace gearpod::analysis {

// Probability of detection that counts as reliable.
inline constexpr double kReliablePd = 0.9;

// Smallest tested fault size at and above which the lower bound of Pd of every group is at least
// `pd`. Empty if not reached. The healthy group (size 0) does not count.
std::optional<SizeGroup> reliable_size(const LevelDetection& level, double pd);

// Number of tests without a miss that demonstrates a probability of `pd` at the confidence: 29 for
// 0.9 at 0.95, the classic demonstration (MIL-HDBK-1823A, section 4.5.2).
long hits_in_a_row(double pd, double confidence);

// Demonstrated size from individual gearboxes; `hit`: 1 detected, 0 missed, -1 no value. With N =
// hits_in_a_row(), returns the N-th smallest detected size above the largest missed size. Testing
// down from the largest size, one gearbox at a time, is a sequence in an order fixed beforehand
// that stops at the first failure. The confidence therefore holds for all tests together, if larger
// faults are not found less often. NaN if there are too few gearboxes.
double size_beyond_misses(std::span<const double> sizes, std::span<const int> hit, double pd,
                          double confidence);

// Smaller of two demonstrated sizes: that of the size groups (with two-sided intervals), and that
// of the individual gearboxes. Each has half of the error probability. NaN if there is neither.
double demonstrated_size(const LevelDetection& level, std::span<const double> sizes,
                         std::span<const int> hit, double pd, double confidence);

}  // namespace gearpod::analysis
