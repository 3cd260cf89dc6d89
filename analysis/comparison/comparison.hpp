// What a change of sensor, feature or design does to detection: differences of detection rates, a90
// and areas under the ROC, each with an interval. On the same gearboxes where they are (paired),
// which takes out of a difference what the gearboxes have in common.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "analysis/detection/detection.hpp"
#include "analysis/statistics/difference_interval.hpp"

namespace gearpod::analysis {

// One feature at one noise level. Paired samples have the same gearboxes in the same places.
struct ComparedSample {
    Alarm alarm = Alarm::high;
    std::span<const double> healthy;  // threshold sample; NaN: no value
    std::span<const double> graded_size;
    std::span<const double> graded;
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
    // Of b - a: the wider of Newcombe's, which takes the thresholds as given, and the percentiles
    // of the resamples, which set them anew.
    Interval bounds;
    PairedCounts pairs;    // of those with a value in both; none if not paired
    double p_value = 1.0;  // McNemar, or the pooled test
};

struct NumberDifference {
    double a = 0.0, b = 0.0;
    Interval bounds;        // of b - a; infinite: open
    double p_value = kNan;  // of the areas: DeLong's
    std::string refusal;    // why there is none, else empty

    double difference() const { return b - a; }
};

struct Comparison {
    std::vector<RateDifference> rates;  // by group
    NumberDifference a90;               // the curve's estimate; percentiles of the resamples
    NumberDifference auc;
};

// Both samples' thresholds are their own. Throws std::invalid_argument if paired samples differ in
// length or sizes. The same numbers whatever the threads.
Comparison compare_detection(const ComparedSample& a, const ComparedSample& b,
                             const ComparisonRequest& request, int threads);

}  // namespace gearpod::analysis
