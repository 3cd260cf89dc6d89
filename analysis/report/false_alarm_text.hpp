// Text on whether the samples are large enough for the requested false-alarm rate and for showing
// a detection rate, printed before a run and with the report. Also the sample and cost of rarer
// false alarms as JSON.
#pragma once

#include <span>
#include <string>

#include "analysis/detection/detection_table.hpp"
#include "analysis/report/wording.hpp"

namespace gearpod::analysis {

// Shortage of `healthy` gearboxes that set thresholds: there is no threshold, thresholds are
// extrapolated beyond the sample, or the false-alarm rate may be more than twice the requested one;
// with the number needed. "" if they suffice. One or two sentences. `records`: records per gearbox.
// `importance_sampled`: they are importance-sampled, which applies to some features only; the text
// then describes the other features' thresholds.
std::string sample_shortage(long healthy, double false_alarm_rate, double confidence,
                            Subject subject, long records = 1, bool importance_sampled = false);

// Shortage of the smallest sample among a report's thresholds. Names the noise levels that have no
// threshold.
std::string sample_shortage(std::span<const FeatureDetection> features,
                            const DetectionRequest& request, Subject subject);

// Fewest tests of one size, all of them detected, with which the lower bound of their rate is at
// least `pd`, by the interval that the tables of rates print (Wilson).
long tests_to_show(double pd, double confidence);

// Shortage of `tests` gearboxes that are shared by the fixed sizes of the request: even without a
// miss their lower bound is below kReliablePd. "" if they suffice, and for continuous sizes.
std::string size_shortage(long tests, const DetectionRequest& request);

// Healthy records needed for a threshold at the rate, by order statistic, tail fit and importance
// sampling.
std::string threshold_methods_text(double false_alarm_rate, double confidence);

// True if no feature has a threshold at the noise level, so that detection is unknown there.
bool without_threshold(std::span<const FeatureDetection> features, std::size_t level);

}  // namespace gearpod::analysis
