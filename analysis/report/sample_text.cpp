#include "analysis/report/sample_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/detection/false_alarm_rate.hpp"

namespace gearpod::analysis {
namespace {

long largest_sample(std::span<const FeatureDetection> features, std::size_t level) {
    long largest = 0;
    for (const FeatureDetection& feature : features) {
        largest = std::max(largest, feature.levels[level].threshold_sample);
    }
    return largest;
}

}  // namespace

std::string sample_shortage(long healthy, double false_alarm_rate, double confidence,
                            Subject subject) {
    if (threshold_rank(healthy, false_alarm_rate) > healthy) {
        return fmt::format(
            "Too few healthy {} for a false-alarm rate of {:g}: {} give no threshold, so nothing "
            "can be said of faults. It takes {}, and {} for a rate of at most twice that at {:g} % "
            "confidence.",
            many(subject), false_alarm_rate, healthy, sample_for_threshold(false_alarm_rate),
            sample_for_rate(false_alarm_rate, confidence), 100.0 * confidence);
    }
    const Interval rate = threshold_rate_interval(healthy, false_alarm_rate, confidence);
    if (rate.upper <= 2.0 * false_alarm_rate) {
        return "";
    }
    return fmt::format(
        "Few healthy {} for a false-alarm rate of {:g}: {} fix it to between {:.2g} and {:.2g} at "
        "{:g} % confidence. It takes {} for a rate of at most twice that.",
        many(subject), false_alarm_rate, healthy, rate.lower, rate.upper, 100.0 * confidence,
        sample_for_rate(false_alarm_rate, confidence));
}

std::string sample_shortage(std::span<const FeatureDetection> features,
                            const DetectionRequest& request, Subject subject) {
    if (features.empty() || features.front().levels.empty()) {
        return "";
    }
    const std::size_t levels = features.front().levels.size();
    std::vector<std::string> without;
    long fewest = largest_sample(features, 0);
    for (std::size_t n = 0; n < levels; ++n) {
        fewest = std::min(fewest, largest_sample(features, n));
        if (without_threshold(features, n)) {
            without.push_back(fmt::format("x {:g}", request.noise_levels[n]));
        }
    }
    const std::string text =
        sample_shortage(fewest, request.false_alarm_rate, request.confidence, subject);
    return without.empty() || without.size() == levels || text.empty()
               ? text
               : fmt::format("At noise {}: {}", fmt::join(without, ", "), text);
}

bool without_threshold(std::span<const FeatureDetection> features, std::size_t level) {
    return std::all_of(features.begin(), features.end(), [&](const FeatureDetection& feature) {
        return std::isnan(feature.levels[level].threshold);
    });
}

}  // namespace gearpod::analysis
