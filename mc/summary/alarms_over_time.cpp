#include "mc/summary/alarms_over_time.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>

#include "analysis/detection/threshold.hpp"
#include "analysis/report/text_lines.hpp"
#include "features/median.hpp"

namespace gearpod::mc {
namespace {

constexpr std::size_t kMostGroups = 40;

std::optional<std::size_t> time_column(const Results& frame) {
    for (std::size_t p = 0; p < frame.parameters.size(); ++p) {
        if (frame.parameters[p].name == "time") {
            return p;
        }
    }
    return std::nullopt;
}

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

std::vector<std::size_t> ranked_features(const Results& frame,
                                         const std::optional<analysis::Reliability>& reliability) {
    if (reliability && !reliability->rankings.empty()) {
        return in_rank_order(*reliability, 0);
    }
    std::vector<std::size_t> order(frame.features.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    return order;
}

std::vector<TimeGroup> alarms_over_time(const Results& frame, const RowSource& rows) {
    const auto time = time_column(frame);
    if (!time || frame.provenance_value("kind") != kRecordingsKind) {
        return {};
    }
    const RowShape shape = row_shape(frame);
    std::vector<double> times;
    std::vector<std::vector<double>> values(shape.features);
    rows.visit([&](const RowBlock& block) {
        for (std::size_t row = 0; row < block.count(); ++row) {
            const double* of_row = block.values.data() + row * shape.values();
            times.push_back(of_row[*time]);
            for (std::size_t f = 0; f < shape.features; ++f) {
                values[f].push_back(of_row[shape.value_of(f, 0)]);
            }
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

std::string alarms_text(const Results& frame, const std::vector<TimeGroup>& groups,
                        const std::optional<analysis::Reliability>& reliability) {
    constexpr std::size_t kLabel = 26, kEach = 18;  // columns
    if (groups.empty() || frame.features.empty()) {
        return "";
    }
    auto order = ranked_features(frame, reliability);
    order.resize(std::min(order.size(), (analysis::text_width() - kLabel) / kEach));
    const std::size_t time = *time_column(frame);
    const std::string unit = frame.parameters[time].unit;
    std::string out =
        fmt::format("Alarms over time{} (recordings with an alarm; median of the feature)\n",
                    unit == "1" ? "" : ", " + unit);
    out += fmt::format("{:<16}{:>10}", "time", "recordings");
    for (const std::size_t f : order) {
        out += fmt::format("{:>18}", frame.features[f].name);
    }
    out += "\n";
    for (const TimeGroup& group : groups) {
        const std::string when = group.first == group.last
                                     ? fmt::format("{:g}", group.last)
                                     : fmt::format("{:g} to {:g}", group.first, group.last);
        out += fmt::format("{:<16}{:>10}", when, group.recordings);
        for (const std::size_t f : order) {
            const double share =
                static_cast<double>(group.alarms[f]) / static_cast<double>(group.values[f]);
            out += group.alarms[f] < 0 ? fmt::format("{:>9}", "-")
                                       : fmt::format("{:>7.0f} %", 100.0 * share);
            out += group.values[f] == 0 ? fmt::format("{:>9}", "-")
                                        : fmt::format("{:>9.3g}", group.medians[f]);
        }
        out += "\n";
    }
    return out;
}

nlohmann::json alarms_json(const Results& frame, const std::vector<TimeGroup>& groups) {
    nlohmann::json json = nlohmann::json::array();
    for (const TimeGroup& group : groups) {
        nlohmann::json values = nlohmann::json::object(), alarms = values, medians = values;
        for (std::size_t f = 0; f < frame.features.size(); ++f) {
            values[frame.features[f].name] = group.values[f];
            alarms[frame.features[f].name] =
                group.alarms[f] < 0 ? nlohmann::json(nullptr) : nlohmann::json(group.alarms[f]);
            medians[frame.features[f].name] = std::isfinite(group.medians[f])
                                                  ? nlohmann::json(group.medians[f])
                                                  : nlohmann::json(nullptr);
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
