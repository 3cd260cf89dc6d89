// False alarms in words: whether a healthy sample is large enough for the rate asked of it, said
// before a run and as a report's first line; and what rarer ones cost, in size and money.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "analysis/detection/detection_table.hpp"
#include "analysis/false_alarm_curve.hpp"
#include "analysis/report/subject.hpp"

namespace gearpod::analysis {

// Of `healthy` that set thresholds: that there is none, that they lie beyond the sample, or that
// their false-alarm rate may be more than twice the one asked for, and how many it takes; "" where
// they suffice. One sentence or two. Of several records each, `tilted` ones serve some features
// only: what the others rest on.
std::string sample_shortage(long healthy, double false_alarm_rate, double confidence,
                            Subject subject, long records = 1, bool tilted = false);

// The same of the smallest sample among a report's thresholds, which names the noise levels that
// have none at all.
std::string sample_shortage(std::span<const FeatureDetection> features,
                            const DetectionRequest& request, Subject subject);

// No feature has a threshold at the noise level: nothing is known of the faults there.
bool without_threshold(std::span<const FeatureDetection> features, std::size_t level);

// One paragraph: a90 with its bounds by false-alarm rate, and up to where the sample carries; or why
// there is none.
std::string false_alarm_text(const std::string& feature, const FalseAlarmCurve& curve,
                             const SizeGroup& tested, const SizeUnit& unit, double confidence);

// One paragraph: the threshold of least expected cost.
std::string least_cost_text(const std::string& feature, const LeastCost& least, double confidence);

// {"refusal", "points": [{"false_alarm_rate", "threshold", "extrapolation": null for an order
//   statistic, "tilted": of tilted records, "threshold_bounds": [lower, upper] (null: open), "a90":
//   {"estimate", "lower", "upper"}}], "unfitted": [rates at which no curve fits]}
nlohmann::json false_alarm_json(const FalseAlarmCurve& curve);
// {"threshold", "extrapolation", "tilted", "false_alarm_rate", "rate_bounds", "pd", "pd_bounds",
// "cost",
//  "bounds", "without", "rarest"}
nlohmann::json least_cost_json(const LeastCost& least);

}  // namespace gearpod::analysis
