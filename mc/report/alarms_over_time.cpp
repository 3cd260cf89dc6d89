#include "mc/report/alarms_over_time.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "analysis/detection/threshold.hpp"
#include "analysis/report/json_values.hpp"
#include "analysis/report/wording.hpp"
#include "features/statistics/median.hpp"

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
               : std::numeric_limits<double>::quiet_NaN();
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
        TimeGroup group;
        group.first = end;
        group.last = end;
        group.alarms.assign(shape.features, 0);
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

}  // namespace gearpod::mc
