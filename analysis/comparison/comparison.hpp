// Effect of a change of sensor, feature or design on detection: differences of detection rates, a90
// and areas under the ROC curve, each with an interval. If both samples have the same gearboxes
// (paired), the variation common to both is removed from the difference.
#pragma once

#include <random>
#include <span>
#include <string>
#include <vector>

#include "analysis/detection/detection.hpp"
#include "analysis/statistics/interval.hpp"
#include "machine/fields.hpp"

namespace gearpod::analysis {

// Values of one feature at one noise level. Paired samples have the same gearboxes at the same
// indices.
struct ComparedSample {
    Alarm alarm = Alarm::high;
    std::span<const double> healthy;  // threshold sample; NaN: no value
    std::span<const double> test_size;
    std::span<const double> test;
};

struct ComparisonRequest {
    double false_alarm_rate = 0.05;
    double confidence = 0.95;
    std::vector<SizeGroup> groups;  // common to both
    bool paired = false;
    int resamples = 400;
};

struct RateDifference {
    SizeGroup size;
    long tested_a = 0, tested_b = 0;
    double a = 0.0, b = 0.0;  // detection rates; NaN if none was tested
    // Interval of b - a: the wider of Newcombe's, which takes the thresholds as given, and the
    // percentiles of the resamples, which set new thresholds.
    Interval bounds;
    PairedCounts pairs;    // gearboxes with a value in both; empty if not paired
    double p_value = 1.0;  // McNemar, or the pooled test
};
GEARPOD_FIELDS(RateDifference, size_low_high, tested_a_, tested_b_, a_, b_, lower_upper, pairs_,
               p_value)

struct NumberDifference {
    double a = 0.0, b = 0.0;
    Interval bounds;        // of b - a; infinite: open
    double p_value = kNan;  // DeLong's test, for areas only
    std::string refusal;    // reason why there is no difference, or ""

    double difference() const { return b - a; }
};
GEARPOD_FIELDS(NumberDifference, a_, b_, lower_upper, p_value, refusal)

struct Comparison {
    std::vector<RateDifference> rates;  // by group
    NumberDifference a90;  // estimates of the curves; interval from percentiles of the resamples
    NumberDifference auc;
};

// Compares two samples, each with its own threshold. Throws std::invalid_argument if paired samples
// differ in length or sizes. Results do not depend on the number of threads.
Comparison compare_detection(const ComparedSample& a, const ComparedSample& b,
                             const ComparisonRequest& request, int threads);

// Index below `count` for a resample: uniform to count / 2^32, and the same with every library.
std::size_t uniform_index(std::mt19937_64& engine, std::size_t count);

}  // namespace gearpod::analysis
