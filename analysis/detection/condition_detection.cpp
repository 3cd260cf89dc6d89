#include "analysis/detection/condition_detection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "analysis/detection/detection.hpp"
#include "analysis/detection/false_alarm_rate.hpp"
#include "analysis/detection/healthy_thresholds.hpp"

namespace gearpod::analysis {
namespace {

constexpr std::size_t kMostConditions = 50;

ConditionThreshold threshold_of(double condition, const FeatureSample& healthy,
                                const ConditionColumn& column, std::size_t level, Alarm alarm,
                                const DetectionRequest& request) {
    std::vector<double> values;
    std::vector<std::size_t> gearbox;
    const std::size_t levels = request.noise_levels.size();
    for (std::size_t i = 0; i < column.healthy.size(); ++i) {
        if (column.healthy[i] == condition) {
            values.push_back(healthy.values[i * levels + level]);
            gearbox.push_back(column.gearbox.empty() ? i : column.gearbox[i]);
        }
    }
    const HealthyThresholds sample({values, gearbox}, alarm);
    const Threshold threshold = sample.at(request.false_alarm_rate, request.confidence);
    return {condition, threshold.value, threshold.sample, threshold.alarms,
            sample.rate_bounds(threshold, request.false_alarm_rate, request.confidence)};
}

void warn(const ConditionLevel& level, const ConditionColumn& column,
          const DetectionRequest& request, std::vector<std::string>& warnings) {
    const auto small = std::count_if(
        level.thresholds.begin(), level.thresholds.end(), [&](const ConditionThreshold& threshold) {
            return !(threshold.rate.upper <= 2.0 * request.false_alarm_rate);
        });
    if (small > 0) {
        warnings.push_back(
            fmt::format("noise level {:g}: {} of {} values of {} have too few healthy gearboxes "
                        "for a false-alarm rate of {:g}; each needs {}",
                        level.noise_level, small, level.thresholds.size(), column.name,
                        request.false_alarm_rate,
                        sample_for_rate(request.false_alarm_rate, request.confidence)));
    }
    if (level.without > 0) {
        warnings.push_back(
            fmt::format("noise level {:g}: {} test gearboxes have a value of {} without a "
                        "threshold and are not counted",
                        level.noise_level, level.without, column.name));
    }
}

}  // namespace

ConditionDetection detect_by_condition(const std::string& feature, Alarm alarm,
                                       const FeatureSample& healthy, const FeatureSample& test,
                                       const ConditionColumn& column,
                                       const DetectionRequest& request) {
    const std::size_t levels = request.noise_levels.size();
    if (column.healthy.size() * levels != healthy.values.size() ||
        column.test.size() * levels != test.values.size()) {
        throw std::invalid_argument("condition detection: needs one condition per gearbox");
    }
    ConditionDetection result{feature, column.name, column.unit, alarm, {}, {}, {}};
    if (!std::ranges::all_of(column.healthy, [](double value) { return std::isfinite(value); })) {
        result.refusal = fmt::format("{} is not known of every healthy gearbox", column.name);
        return result;
    }
    const std::set<double> conditions(column.healthy.begin(), column.healthy.end());
    if (conditions.empty() || conditions.size() > kMostConditions) {
        result.refusal = conditions.empty() ? "no healthy gearboxes"
                                            : fmt::format(
                                                  "{} has {} different values; an operating "
                                                  "condition must have few levels that repeat",
                                                  column.name, conditions.size());
        return result;
    }
    const std::vector<std::size_t> group = groups_of(test.fault_size, request.groups);
    for (std::size_t n = 0; n < levels; ++n) {
        ConditionLevel level;
        level.noise_level = request.noise_levels[n];
        for (const double condition : conditions) {
            level.thresholds.push_back(threshold_of(condition, healthy, column, n, alarm, request));
        }
        level.cells.resize(request.groups.size());
        for (std::size_t g = 0; g < request.groups.size(); ++g) {
            level.cells[g].size = request.groups[g];
        }
        for (std::size_t i = 0; i < group.size(); ++i) {
            if (group[i] == kNoGroup) {
                continue;
            }
            const auto known = std::find_if(
                level.thresholds.begin(), level.thresholds.end(),
                [&](const ConditionThreshold& t) { return t.condition == column.test[i]; });
            if (known == level.thresholds.end() || std::isnan(known->threshold)) {
                ++level.without;
                continue;
            }
            count(level.cells[group[i]], test.values[i * levels + n], known->threshold, alarm);
        }
        for (DetectionCell& cell : level.cells) {
            rate(cell, true, request.confidence);
        }
        warn(level, column, request, result.warnings);
        result.levels.push_back(std::move(level));
    }
    return result;
}

}  // namespace gearpod::analysis
