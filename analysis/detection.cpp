#include "analysis/detection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "analysis/size_groups.hpp"
#include "analysis/threshold.hpp"
#include "analysis/wilson.hpp"

namespace gearpod::analysis {
namespace {

constexpr std::size_t kNoGroup = static_cast<std::size_t>(-1);

void check_shapes(const FeatureSample& sample, std::size_t levels, const char* which) {
    if (sample.values.size() != sample.fault_size.size() * levels) {
        throw std::invalid_argument(
            fmt::format("detection: {} {} values for {} gearboxes at {} noise levels",
                        sample.values.size(), which, sample.fault_size.size(), levels));
    }
}

void check_request(const DetectionRequest& request) {
    if (!(request.false_alarm_rate > 0.0 && request.false_alarm_rate < 1.0)) {
        throw std::invalid_argument("detection: the false-alarm rate must lie between 0 and 1");
    }
    for (std::size_t g = 0; g < request.groups.size(); ++g) {
        const SizeGroup& group = request.groups[g];
        if (group.high < group.low || (g > 0 && group.low < request.groups[g - 1].high)) {
            throw std::invalid_argument("detection: the size groups must ascend");
        }
    }
}

std::vector<std::size_t> groups_of(std::span<const double> sizes,
                                   const std::vector<SizeGroup>& groups) {
    std::vector<std::size_t> out;
    out.reserve(sizes.size());
    for (const double size : sizes) {
        out.push_back(group_of(size, groups).value_or(kNoGroup));
    }
    return out;
}

void count(DetectionCell& cell, double value, double threshold, Alarm alarm) {
    if (!std::isfinite(value)) {
        ++cell.failed;
        return;
    }
    ++cell.tested;
    cell.detected += is_alarm(value, threshold, alarm) ? 1 : 0;
}

// Without a threshold there is no rate, but the gearboxes are still counted.
void rate(DetectionCell& cell, bool has_threshold, double confidence) {
    if (!has_threshold || cell.tested == 0) {
        cell.pd = cell.lower = cell.upper = std::numeric_limits<double>::quiet_NaN();
        return;
    }
    const Interval bounds = wilson_interval(cell.detected, cell.tested, confidence);
    cell.pd = static_cast<double>(cell.detected) / static_cast<double>(cell.tested);
    cell.lower = bounds.lower;
    cell.upper = bounds.upper;
}

std::vector<double> column(const FeatureSample& sample, std::size_t level, std::size_t levels) {
    std::vector<double> values;
    values.reserve(sample.fault_size.size());
    for (std::size_t i = 0; i < sample.fault_size.size(); ++i) {
        values.push_back(sample.values[i * levels + level]);
    }
    return values;
}

void warn(const LevelDetection& level, std::size_t healthy, double rate,
          std::vector<std::string>& warnings) {
    if (std::isnan(level.threshold)) {
        warnings.push_back(fmt::format(
            "noise level {:g}: no threshold, {} healthy gearboxes are too few for a false-alarm "
            "rate of {:g}; it takes {:.0f}",
            level.noise_level, level.threshold_sample, rate, std::ceil(1.0 / rate - 1.0 - 1e-9)));
    }
    const long without = static_cast<long>(healthy) - level.threshold_sample;
    if (without > 0) {
        warnings.push_back(fmt::format(
            "noise level {:g}: {} of {} healthy gearboxes gave no value and do not count "
            "in the threshold",
            level.noise_level, without, healthy));
    }
}

}  // namespace

FeatureDetection detect(const std::string& feature, Alarm alarm, const FeatureSample& healthy,
                        const FeatureSample& graded, const DetectionRequest& request) {
    const std::size_t levels = request.noise_levels.size();
    check_shapes(healthy, levels, "healthy");
    check_shapes(graded, levels, "graded");
    check_request(request);
    FeatureDetection result;
    result.feature = feature;
    result.alarm = alarm;
    const std::vector<std::size_t> group = groups_of(graded.fault_size, request.groups);
    for (std::size_t n = 0; n < levels; ++n) {
        LevelDetection level;
        level.noise_level = request.noise_levels[n];
        const Threshold threshold =
            alarm_threshold(column(healthy, n, levels), alarm, request.false_alarm_rate);
        level.threshold = threshold.value;
        level.threshold_sample = threshold.sample;
        level.threshold_alarms = threshold.alarms;
        level.cells.resize(request.groups.size());
        for (std::size_t g = 0; g < request.groups.size(); ++g) {
            level.cells[g].size = request.groups[g];
        }
        for (std::size_t i = 0; i < group.size(); ++i) {
            if (group[i] != kNoGroup) {
                count(level.cells[group[i]], graded.values[i * levels + n], level.threshold, alarm);
            }
        }
        for (DetectionCell& cell : level.cells) {
            rate(cell, !std::isnan(level.threshold), request.confidence);
        }
        warn(level, healthy.fault_size.size(), request.false_alarm_rate, result.warnings);
        result.levels.push_back(std::move(level));
    }
    if (const auto outside = std::count(group.begin(), group.end(), kNoGroup); outside > 0) {
        result.warnings.push_back(fmt::format(
            "{} of {} gearboxes have a fault size outside all size groups and do not count",
            outside, group.size()));
    }
    return result;
}

}  // namespace gearpod::analysis
