#include "analysis/report/false_alarm_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/detection/detection.hpp"
#include "analysis/detection/importance_sample.hpp"
#include "analysis/detection/threshold.hpp"
#include "analysis/false_alarm_curve.hpp"
#include "analysis/report/json_values.hpp"
#include "features/feature.hpp"

namespace gearpod::analysis {
namespace {

long largest_sample(std::span<const FeatureDetection> features, std::size_t level) {
    long largest = 0;
    for (const FeatureDetection& feature : features) {
        largest = std::max(largest, feature.levels[level].threshold_sample);
    }
    return largest;
}

// Widest interval that is wider than that of as many independent recordings (detection.hpp); 0 if
// there is none.
Interval clustered_rate(std::span<const FeatureDetection> features,
                        const DetectionRequest& request) {
    Interval widest{0.0, 0.0};
    for (const FeatureDetection& feature : features) {
        for (const LevelDetection& level : feature.levels) {
            const Interval independent = threshold_rate_interval(
                level.threshold_sample, request.false_alarm_rate, request.confidence);
            if (!level.tail && level.threshold_rate.upper > independent.upper + 1e-9 &&
                level.threshold_rate.upper > widest.upper) {
                widest = level.threshold_rate;
            }
        }
    }
    return widest;
}

// Text on the thresholds whose rate remains undetermined with several records of each gearbox.
std::string undetermined_rate_text(std::span<const FeatureDetection> features,
                                   const DetectionRequest& request, double upper) {
    long open = 0, all = 0;
    for (const FeatureDetection& feature : features) {
        for (const LevelDetection& level : feature.levels) {
            ++all;
            open += level.threshold_rate.upper > 2.0 * request.false_alarm_rate ? 1 : 0;
        }
    }
    return fmt::format(
        "Healthy gearboxes differ too much to ensure a false-alarm rate of {:g} for {} of the {} "
        "thresholds: it may be up to {:.2g}. More gearboxes are needed, not more records of each.",
        request.false_alarm_rate, open, all, upper);
}

// Numbers of thresholds by method, for a study with importance-sampled records.
struct ImportanceSampledCounts {
    long all = 0, importance_sampled = 0, gearboxes = 0;
    // From the first record of each gearbox, because too few gearboxes have the alarms.
    long first = 0;
    // From plain records, for features without importance sampling; of these, without a threshold.
    long plain = 0, none = 0;
    double upper = 0.0;  // largest upper bound of the rate among the plain thresholds
};

ImportanceSampledCounts importance_sampled_counts(std::span<const FeatureDetection> features,
                                                  const DetectionRequest& request) {
    ImportanceSampledCounts counts;
    for (const FeatureDetection& feature : features) {
        const features::Feature* known = features::find_feature(feature.feature);
        const bool plain = known != nullptr && !known->from_sensor;
        const long records = plain ? static_cast<long>(request.threshold_records) : 1;
        for (const LevelDetection& level : feature.levels) {
            ++counts.all;
            counts.importance_sampled += level.importance_sampled ? 1 : 0;
            counts.gearboxes = std::max(counts.gearboxes, level.importance_sampled
                                                              ? level.importance_sampled->gearboxes
                                                              : level.threshold_sample / records);
            counts.first += !level.importance_sampled && !plain ? 1 : 0;
            if (plain) {
                const bool none = std::isnan(level.threshold);
                ++counts.plain;
                counts.none += none ? 1 : 0;
                counts.upper = std::max(counts.upper, none ? 0.0 : level.threshold_rate.upper);
            }
        }
    }
    return counts;
}

// Text on thresholds from plain records; "" if they keep the rate.
std::string plain_text(const ImportanceSampledCounts& counts, double false_alarm_rate) {
    std::string text;
    if (counts.none > 0) {
        text = fmt::format(" {} for features without accelerometer noise {} too few records.",
                           counts.none, counts.none == 1 ? "has" : "have");
    }
    if (counts.upper > 2.0 * false_alarm_rate) {
        const long with = counts.plain - counts.none;
        text += fmt::format(
            " {} {} from records without importance sampling: the rate may be up to {:.2g}.", with,
            with == 1 ? "is" : "are", counts.upper);
    }
    return text;
}

// Text on the thresholds from importance sampling, and on the methods of the others.
std::string importance_sampling_text(std::span<const FeatureDetection> features,
                                     const DetectionRequest& request) {
    const ImportanceSampledCounts counts = importance_sampled_counts(features, request);
    std::string text;
    if (counts.importance_sampled > 0) {
        const double rarer =
            1.0 / (request.false_alarm_rate * static_cast<double>(counts.gearboxes));
        text = fmt::format(
            " {} of the {} thresholds {} from importance sampling with {} records of each of {} "
            "healthy gearboxes{}.",
            counts.importance_sampled, counts.all, counts.importance_sampled == 1 ? "is" : "are",
            request.threshold_records, counts.gearboxes,
            rarer > 1.0
                ? fmt::format(", for a false-alarm rate {:.2g} times rarer than one in these",
                              rarer)
                : "");
    }
    const std::string others = counts.first > 0
                                   ? sample_shortage(counts.gearboxes, request.false_alarm_rate,
                                                     request.confidence, Subject::gearboxes)
                                   : "";
    if (!others.empty()) {
        text += (counts.importance_sampled > 0
                     ? fmt::format(" For {} other{}, too few gearboxes have alarms", counts.first,
                                   counts.first == 1 ? "" : "s")
                     : " Too few gearboxes have alarms for thresholds from importance sampling") +
                " (`gearpod rare` samples rare gearboxes instead). " + others;
    }
    text += plain_text(counts, request.false_alarm_rate);
    return text.empty() ? "" : text.substr(1);
}

// Shortage of gearboxes with several records each. There is no extrapolation, because their tails
// are correlated.
std::string record_shortage(long gearboxes, long records, double false_alarm_rate,
                            double confidence) {
    const long all = gearboxes * records;
    const auto each = [&](long needed) { return (needed + gearboxes - 1) / gearboxes; };
    const long least = sample_for_threshold(false_alarm_rate);
    const Interval rate = threshold_rate_interval(all, false_alarm_rate, confidence);
    if (rate.upper <= 2.0 * false_alarm_rate) {
        return "";
    }
    const std::string found =
        all < least
            ? fmt::format(
                  "a false-alarm rate of {:g} is rarer than one in them, and records of one "
                  "gearbox are too similar to extrapolate. At least {} of each are needed, and {}",
                  false_alarm_rate, each(least),
                  each(sample_for_rate(false_alarm_rate, confidence)))
            : fmt::format(
                  "they determine a false-alarm rate of {:g} only to between {:.2g} and {:.2g} at "
                  "{:g} % confidence. At least {} of each are needed",
                  false_alarm_rate, rate.lower, rate.upper, 100.0 * confidence,
                  each(sample_for_rate(false_alarm_rate, confidence)));
    return fmt::format(
        "Few records ({} of each of {} healthy gearboxes): {} for a rate of at most "
        "twice that.",
        records, gearboxes, found);
}

}  // namespace

long tests_to_show(double pd, double confidence) {
    long tests = 1;
    while (wilson_interval(tests, tests, confidence).lower < pd) {
        ++tests;
    }
    return tests;
}

std::string size_shortage(long tests, const DetectionRequest& request) {
    const bool faulty = std::ranges::any_of(
        request.groups, [](const SizeGroup& group) { return group.high > 0.0; });
    const bool fixed = std::ranges::all_of(
        request.groups, [](const SizeGroup& group) { return group.low == group.high; });
    const auto sizes = static_cast<long>(request.groups.size());
    const long needed = tests_to_show(kReliablePd, request.confidence);
    if (!faulty || !fixed || tests / sizes >= needed) {
        return "";
    }
    return fmt::format(
        "Few gearboxes ({} for each of {} fault sizes): no size alone can show {} detection at {} "
        "confidence, which takes {} without a miss. Set ensemble.instances to {} or more.",
        tests / sizes, sizes, percent_text(kReliablePd), percent_text(request.confidence), needed,
        needed * sizes);
}

std::string threshold_methods_text(double false_alarm_rate, double confidence) {
    const long by_order = sample_for_threshold(false_alarm_rate),
               by_tail = sample_for_tail(false_alarm_rate);
    return fmt::format(
        "Healthy records needed for a rate of {:.3g}: {} by order statistic, and {} to show with "
        "{} "
        "confidence that the rate is at most twice that{}. Importance sampling "
        "(ensemble.threshold_tilt), for accelerometer features only, needs {:g} gearboxes in which "
        "noise causes alarms.",
        false_alarm_rate, by_order, sample_for_rate(false_alarm_rate, confidence),
        percent_text(confidence),
        by_tail < by_order ? fmt::format("; {} by a tail fit to the most extreme values", by_tail)
                           : "",
        kLeastContributing);
}

std::string sample_shortage(long healthy, double false_alarm_rate, double confidence,
                            Subject subject, long records, bool importance_sampled) {
    if (records > 1 && importance_sampled) {
        const std::string others = sample_shortage(healthy, false_alarm_rate, confidence, subject);
        if (!others.empty() && static_cast<double>(healthy) < kLeastContributing) {
            return fmt::format(
                "Importance sampling needs at least {:g} gearboxes to set thresholds. {}",
                kLeastContributing, others);
        }
        return others.empty()
                   ? ""
                   : fmt::format(
                         "Importance sampling supports a false-alarm rate of {:g} for "
                         "accelerometer features with alarms by noise in 20 or more of the {} "
                         "healthy gearboxes; the report names them. All other thresholds: {}",
                         false_alarm_rate, healthy, others);
    }
    if (records > 1) {
        return record_shortage(healthy, records, false_alarm_rate, confidence);
    }
    const long without_law = sample_for_threshold(false_alarm_rate),
               by_law = sample_for_tail(false_alarm_rate);
    const std::string enough =
        fmt::format("{} for a rate of at most twice that at {:g} % confidence",
                    sample_for_rate(false_alarm_rate, confidence), 100.0 * confidence);
    if (healthy < std::min(without_law, by_law)) {
        return fmt::format(
            "Too few healthy {} for a false-alarm rate of {:g}: {} give no threshold, so detection "
            "is unknown. At least {} are needed, and {}.",
            plural(subject), false_alarm_rate, healthy,
            by_law < without_law
                ? fmt::format("{} with extrapolation or {} without", by_law, without_law)
                : fmt::format("{}", without_law),
            enough);
    }
    if (healthy < without_law) {
        return fmt::format(
            "A false-alarm rate of {:g} is {:.2g} times rarer than one in {} healthy {}: "
            "thresholds are extrapolated by a generalised Pareto distribution of their {} most "
            "extreme values, and the true rate may be several times higher. Without extrapolation "
            "at least {} are needed, and {}.",
            false_alarm_rate, 1.0 / (false_alarm_rate * static_cast<double>(healthy)), healthy,
            plural(subject), exceedances_of(healthy), without_law, enough);
    }
    const Interval rate = threshold_rate_interval(healthy, false_alarm_rate, confidence);
    if (rate.upper <= 2.0 * false_alarm_rate) {
        return "";
    }
    return fmt::format(
        "Few healthy {} for a false-alarm rate of {:g}: {} determine it only to between {:.2g} and "
        "{:.2g} at {:g} % confidence. At least {} are needed for a rate of at most twice that.",
        plural(subject), false_alarm_rate, healthy, rate.lower, rate.upper, 100.0 * confidence,
        sample_for_rate(false_alarm_rate, confidence));
}

std::string sample_shortage(std::span<const FeatureDetection> features,
                            const DetectionRequest& request, Subject subject) {
    if (features.empty() || features.front().levels.empty()) {
        return "";
    }
    if (request.importance_sampling) {
        return importance_sampling_text(features, request);
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
    const auto records = static_cast<long>(request.threshold_records);
    std::string text = sample_shortage(fewest / records, request.false_alarm_rate,
                                       request.confidence, subject, records);
    const Interval rate = clustered_rate(features, request);
    if (text.empty() && records > 1 && rate.upper > 2.0 * request.false_alarm_rate) {
        text = undetermined_rate_text(features, request, rate.upper);
    } else if (subject == Subject::recordings && rate.upper > 2.0 * request.false_alarm_rate) {
        text = fmt::format(
            "Recordings of too few gearboxes for a false-alarm rate of {:g}: they show only "
            "that it is below {:.2g} at {:g} % confidence. Recordings of more gearboxes are "
            "needed.",
            request.false_alarm_rate, rate.upper, 100.0 * request.confidence);
    }
    return without.empty() || without.size() == levels || text.empty()
               ? text
               : fmt::format("At noise {}: {}", fmt::join(without, ", "), text);
}

bool without_threshold(std::span<const FeatureDetection> features, std::size_t level) {
    return std::all_of(features.begin(), features.end(), [&](const FeatureDetection& feature) {
        return std::isnan(feature.levels[level].threshold);
    });
}

// `extrapolation` is null for a threshold from an order statistic.
Json to_json(const RatePoint& point) {
    Json json = fields_json(point);
    json["extrapolation"] = point.extrapolation > 0.0 ? Json(point.extrapolation) : nullptr;
    return json;
}

}  // namespace gearpod::analysis
