#include "mc/report/alarm_rates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <utility>

#include "analysis/detection/threshold.hpp"
#include "analysis/report/json_values.hpp"
#include "analysis/report/wording.hpp"
#include "features/feature.hpp"
#include "features/statistics/signal_statistics.hpp"
#include "machine/no_value.hpp"

namespace gearpod::mc {
namespace {

constexpr std::size_t kMostGroups = 40;

// Returns the last time of each group.
std::vector<double> ends_of(const std::vector<double>& times) {
    const std::set<double> distinct(times.begin(), times.end());
    if (distinct.size() <= kMostGroups) {
        return {distinct.begin(), distinct.end()};
    }
    std::vector<double> sorted = times;
    std::sort(sorted.begin(), sorted.end());
    std::set<double> ends;
    for (std::size_t i = 1; i <= kMostGroups; ++i) {
        ends.insert(sorted[i * sorted.size() / kMostGroups - 1]);
    }
    return {ends.begin(), ends.end()};
}

double threshold_of(const Results& frame, std::size_t feature) {
    return feature < frame.detection.size() && !frame.detection[feature].levels.empty()
               ? frame.detection[feature].levels.front().threshold
               : kNan;
}

std::size_t other_fault_variant(const Results& frame) {
    const auto found = std::ranges::find(frame.variants, kOtherFault, &Variant::name);
    return static_cast<std::size_t>(found - frame.variants.begin());
}

std::string share_text(const OtherFaultAlarms& one) {
    return analysis::percent_text(static_cast<double>(one.alarms) /
                                  static_cast<double>(one.tested));
}

std::string bounds_text(const OtherFaultAlarms& one) {
    return fmt::format("{} to {}", analysis::percent_text(one.interval.lower),
                       analysis::percent_text(one.interval.upper));
}

}  // namespace

std::vector<TimeGroup> alarms_over_time(const Results& frame, const RowSource& rows) {
    const auto time = frame.parameter_index("time");
    if (!time || frame.provenance_value("kind") != kRecordingsKind) {
        return {};
    }
    const RowShape shape = row_shape(frame);
    std::vector<double> times;
    std::vector<std::vector<double>> values(shape.features);
    for_each_row(rows, [&](const ResultRow& row) {
        times.push_back(row.values[*time]);
        for (std::size_t f = 0; f < shape.features; ++f) {
            values[f].push_back(row.values[shape.value_of(f, 0)]);
        }
    });
    std::vector<TimeGroup> groups;
    double before = -std::numeric_limits<double>::infinity();
    for (const double end : ends_of(times)) {
        TimeGroup group{end, end, 0, {}, std::vector<long>(shape.features, 0), {}};
        std::vector<std::vector<double>> here(shape.features);
        for (std::size_t i = 0; i < times.size(); ++i) {
            if (times[i] <= before || times[i] > end) {
                continue;
            }
            group.first = std::min(group.first, times[i]);
            ++group.recordings;
            for (std::size_t f = 0; f < shape.features; ++f) {
                if (std::isfinite(values[f][i])) {
                    here[f].push_back(values[f][i]);
                    group.alarms[f] += analysis::is_alarm(values[f][i], threshold_of(frame, f),
                                                          frame.features[f].alarm);
                }
            }
        }
        for (std::size_t f = 0; f < shape.features; ++f) {
            group.values.push_back(static_cast<long>(here[f].size()));
            group.medians.push_back(features::median(here[f]));
            if (here[f].empty() || std::isnan(threshold_of(frame, f))) {
                group.alarms[f] = -1;
            }
        }
        groups.push_back(std::move(group));
        before = end;
    }
    return groups;
}

analysis::Section alarms_section(const Results& frame, const std::vector<TimeGroup>& groups,
                                 const std::vector<std::size_t>& ranked) {
    constexpr std::size_t kMostFeatures = 3;
    if (groups.empty() || frame.features.empty()) {
        return {};
    }
    const std::string unit = frame.parameters[*frame.parameter_index("time")].unit;
    analysis::Table table{"over_time",
                          "Recordings with an alarm, and the feature's median",
                          {"time", "recordings"},
                          {}};
    const std::span<const std::size_t> shown(ranked.data(), std::min(ranked.size(), kMostFeatures));
    for (const std::size_t f : shown) {
        table.columns.push_back(frame.features[f].name);
    }
    for (const TimeGroup& group : groups) {
        const std::string last = analysis::number_text(group.last);
        std::vector<std::string> row{
            group.first == group.last ? last : analysis::number_text(group.first) + " to " + last,
            fmt::format("{}", group.recordings)};
        for (const std::size_t f : shown) {
            row.push_back(fmt::format(
                "{} ({})",
                group.alarms[f] < 0 ? std::string("-")
                                    : fmt::format("{} of {}", group.alarms[f], group.values[f]),
                analysis::number_text(group.medians[f])));
        }
        table.rows.push_back(std::move(row));
    }
    analysis::Section section{
        "over_time", "Alarms over time" + (unit == "1" ? "" : ", " + unit), {}};
    section.add(std::move(table));
    return section;
}

nlohmann::json alarms_json(const Results& frame, const std::vector<TimeGroup>& groups) {
    nlohmann::json json = nlohmann::json::array();
    for (const TimeGroup& group : groups) {
        nlohmann::json values = nlohmann::json::object(), alarms = values, medians = values;
        for (std::size_t f = 0; f < frame.features.size(); ++f) {
            values[frame.features[f].name] = group.values[f];
            alarms[frame.features[f].name] =
                group.alarms[f] < 0 ? nlohmann::json(nullptr) : nlohmann::json(group.alarms[f]);
            medians[frame.features[f].name] = analysis::number(group.medians[f]);
        }
        json.push_back({{"first", group.first},
                        {"last", group.last},
                        {"recordings", group.recordings},
                        {"values", values},
                        {"alarms", alarms},
                        {"medians", medians}});
    }
    return json;
}

std::vector<OtherFaultAlarms> other_fault_alarms(const Results& frame, const RowSource& rows) {
    const RowShape shape = row_shape(frame);
    const std::size_t variant = other_fault_variant(frame);
    if (variant == shape.variants || frame.detection.size() != shape.features) {
        return {};
    }
    std::vector<OtherFaultAlarms> all;
    for (std::size_t f = 0; f < shape.features; ++f) {
        for (std::size_t n = 0; n < frame.detection[f].levels.size(); ++n) {
            const features::Feature* known = features::find_feature(frame.features[f].name);
            // A bearing does not change the transmission error.
            const bool from_sensor = known == nullptr || known->from_sensor;
            if (from_sensor && !std::isnan(frame.detection[f].levels[n].threshold)) {
                all.push_back({f, n, 0, 0, 0, {}});
            }
        }
    }
    for_each_row(rows, [&](const ResultRow& row) {
        for (OtherFaultAlarms& one : all) {
            const double with =
                             row.values[shape.variant_value_of(variant, one.feature) + one.level],
                         without = row.values[shape.value_of(one.feature, one.level)];
            if (std::isfinite(with) && std::isfinite(without)) {
                const double threshold = frame.detection[one.feature].levels[one.level].threshold;
                const analysis::Alarm alarm = frame.features[one.feature].alarm;
                ++one.tested;
                one.alarms += analysis::is_alarm(with, threshold, alarm);
                one.without += analysis::is_alarm(without, threshold, alarm);
            }
        }
    });
    std::erase_if(all, [](const OtherFaultAlarms& one) { return one.tested == 0; });
    for (OtherFaultAlarms& one : all) {
        one.interval = analysis::wilson_interval(one.alarms, one.tested, frame.request.confidence);
    }
    return all;
}

std::string other_fault_limit(const Results& frame, const std::string& fault,
                              const std::vector<OtherFaultAlarms>& alarms,
                              const std::string& feature, std::size_t level) {
    const auto found = std::ranges::find_if(alarms, [&](const OtherFaultAlarms& one) {
        return frame.features[one.feature].name == feature && one.level == level;
    });
    if (found == alarms.end()) {
        return "";
    }
    return fmt::format(
        "{} raises this alarm in {} of {} healthy gearboxes ({}; {} at {} confidence), against {} "
        "without it.",
        analysis::capitalised(fault), found->alarms, found->tested, share_text(*found),
        bounds_text(*found), analysis::percent_text(frame.request.confidence), found->without);
}

analysis::Section other_fault_section(const Results& frame, const std::string& fault,
                                      const std::vector<OtherFaultAlarms>& alarms) {
    analysis::Section section{"other_fault", "Alarms raised by another fault", {}};
    if (alarms.empty()) {
        section.state("other_fault.none",
                      other_fault_variant(frame) < frame.variants.size()
                          ? "Whether the other fault raises alarms is unknown: no feature of the "
                            "acceleration has a threshold."
                          : "");
        return section;
    }
    section.state("other_fault.how",
                  fmt::format("The healthy gearboxes that set the thresholds, with {}: the same "
                              "records, with its vibration added.",
                              fault));
    analysis::Table table{
        "other_fault",
        "Healthy gearboxes with the other fault that raise an alarm",
        {"feature", "noise", "alarms", "of", "share",
         analysis::percent_text(frame.request.confidence) + " interval", "without it"},
        {}};
    for (const OtherFaultAlarms& one : alarms) {
        table.rows.push_back(
            {frame.features[one.feature].name,
             fmt::format("x {}", analysis::number_text(frame.noise_levels[one.level])),
             fmt::format("{}", one.alarms), fmt::format("{}", one.tested), share_text(one),
             bounds_text(one), fmt::format("{}", one.without)});
    }
    section.add(std::move(table));
    return section;
}

}  // namespace gearpod::mc
