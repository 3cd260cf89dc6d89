// Detection rates by size group from healthy and test values at an alarm threshold, and the size
// from which a fault is found reliably.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/detection/detection_table.hpp"
#include "machine/fields.hpp"

namespace gearpod::analysis {

// Assignment of gearboxes to size groups, and the counts of a group.
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

// Detection rates: alarms per fault size at a threshold from an independent healthy sample.
// MIL-HDBK-1823A, section 4; intervals: Wilson (1927), Clopper and Pearson (1934).

// Values of one feature for one set of gearboxes, row-major: values[i * levels + level]. NaN marks
// a failed gearbox.
struct FeatureSample {
    std::span<const double> fault_size;  // one per gearbox
    std::span<const double> values;      // gearboxes x noise levels
    // Gearbox of each row of a healthy sample with several records per gearbox, and
    // importance-sampling weights of the records.
    std::span<const std::size_t> gearbox = {};
    std::span<const double> weights = {};
};

// Sets thresholds from all of `healthy`, whatever their fault_size (threshold.hpp), and
// computes rates from `test`. Intervals assume independent values or importance-sampled records;
// use detect_clustered() for several plain records of each gearbox. Throws
// std::invalid_argument if the shapes disagree, the false-alarm rate is not between 0 and 1, or the
// size groups do not ascend.
FeatureDetection detect(const std::string& feature, Alarm alarm, const FeatureSample& healthy,
                        const FeatureSample& test, const DetectionRequest& request);

// Detection from two-level healthy samples: several recordings of each of fewer gearboxes
// (threshold.hpp).

// Calls detect() and widens the intervals for healthy rows grouped by gearbox. With one row per
// gearbox, or with importance-sampled records, the result is that of detect().
FeatureDetection detect_clustered(const std::string& feature, Alarm alarm,
                                  const FeatureSample& healthy,
                                  std::span<const std::size_t> gearbox, const FeatureSample& test,
                                  const DetectionRequest& request);

// Smallest fault size that a detector finds reliably, demonstrated by tests without a curve.

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

// Detection with a separate threshold for every operating condition (a torque level, for example),
// in addition to the common one. A feature that follows the torque hides faults in its variation.
// Park (2017) finds that the RMS of transmission error grows with the torque.

struct ConditionThreshold {
    double condition = 0.0;  // value of the input that defines the condition
    double threshold = 0.0;  // NaN if the condition has too few healthy gearboxes
    long sample = 0;
    long alarms = 0;
    Interval rate;  // false-alarm rate, as LevelDetection::threshold_rate
};
GEARPOD_FIELDS(ConditionThreshold, condition, threshold, sample, alarms, rate_lower_upper)

struct ConditionLevel {
    double noise_level = 0.0;
    std::vector<ConditionThreshold> thresholds;  // by ascending condition
    std::vector<DetectionCell> cells;  // every gearbox against the threshold of its condition
    long without = 0;  // test gearboxes whose condition has no threshold; they are in no cell
};
GEARPOD_FIELDS(ConditionLevel, noise_level, thresholds, sizes, without_threshold)

struct ConditionDetection {
    std::string feature;
    std::string input;  // column name
    std::string unit;
    Alarm alarm = Alarm::high;
    std::vector<ConditionLevel> levels;
    std::vector<std::string> warnings;
    std::string refusal;  // reason why there is no result, or ""
};
GEARPOD_FIELDS(ConditionDetection, feature, input, unit, alarm_, levels, warnings, refusal)

struct ConditionColumn {
    std::string name;
    std::string unit;
    std::span<const double> healthy;  // one value per gearbox
    std::span<const double> test;
    // Index of the gearbox of each value of `healthy`; empty if every value has its own gearbox.
    std::span<const std::size_t> gearbox = {};
};

// Refuses an input with more than 50 different values, because conditions must be levels, and one
// that is not known of a healthy gearbox. Throws std::invalid_argument unless there is one
// condition per gearbox.
ConditionDetection detect_by_condition(const std::string& feature, Alarm alarm,
                                       const FeatureSample& healthy, const FeatureSample& test,
                                       const ConditionColumn& column,
                                       const DetectionRequest& request);

}  // namespace gearpod::analysis
