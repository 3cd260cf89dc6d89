#include "analysis/detection/detection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "analysis/detection/threshold.hpp"
#include "analysis/statistics/every_nth.hpp"
#include "analysis/statistics/interval.hpp"
#include "machine/upper_median.hpp"

namespace gearpod::analysis {

std::optional<std::size_t> group_of(double size, const std::vector<SizeGroup>& groups) {
    constexpr double kSameSize = 1e-9;
    std::optional<std::size_t> found;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const double slack = kSameSize * std::abs(groups[g].high);
        const bool level = groups[g].low == groups[g].high;
        const double low = level ? groups[g].low - slack : groups[g].low;
        const double high = level ? groups[g].high + slack : groups[g].high;
        if (size >= low && size <= high) {
            found = g;
        }
    }
    return found;
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
        cell.pd = cell.lower = cell.upper = kNan;
        cell.exact = {kNan, kNan};
        return;
    }
    const Interval bounds = wilson_interval(cell.detected, cell.tested, confidence);
    cell.pd = static_cast<double>(cell.detected) / static_cast<double>(cell.tested);
    cell.lower = bounds.lower;
    cell.upper = bounds.upper;
    cell.exact = clopper_pearson_interval(cell.detected, cell.tested, confidence);
}

namespace {

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

double finite_median(std::vector<double> values) {
    std::erase_if(values, [](double value) { return !std::isfinite(value); });
    return values.empty() ? kNan : machine::upper_median(values);
}

// Cell of the test gearboxes without a fault, or nullptr.
const DetectionCell* healthy_cell(const LevelDetection& level) {
    return !level.cells.empty() && level.cells.front().size.high == 0.0 ? &level.cells.front()
                                                                        : nullptr;
}

// True if healthy values equal the threshold. They raise no alarm, so the rate is below that of the
// order statistic by an unknown amount.
bool tied(const LevelDetection& level, const DetectionRequest& request) {
    if (level.importance_sampled) {
        return false;
    }
    const long rank = threshold_rank(level.threshold_sample, request.false_alarm_rate);
    return level.threshold_alarms < level.threshold_sample - rank;
}

// Fits to fewer of the largest values, to check that the threshold does not depend on their number.
TailThreshold tail_threshold(const SortedSample& healthy, Alarm alarm, const Threshold& threshold,
                             const DetectionRequest& request) {
    const double sign = alarm_sign(alarm);
    const auto choice = [&](const TailFit& fit) {
        return TailChoice{fit.exceedances(),
                          sign * fit.above(),
                          fit.shape(),
                          fit.scale(),
                          sign * fit.threshold(request.false_alarm_rate),
                          fit.rate(sign * threshold.value)};
    };
    const Interval bounds =
        rate_of(threshold, alarm, request.false_alarm_rate, 0, 0, request.confidence).bounds;
    TailThreshold tail;
    tail.extrapolation = 1.0 / (request.false_alarm_rate * static_cast<double>(threshold.sample));
    tail.choices.push_back(choice(*threshold.tail));
    for (const long part : {2, 4}) {
        const TailFit fit(healthy.largest(threshold.tail->exceedances() / part), threshold.sample);
        if (fit.refusal().empty()) {
            tail.choices.push_back(choice(fit));
            const double rate = tail.choices.back().rate;
            tail.steady = tail.steady && rate >= bounds.lower && rate <= bounds.upper;
        }
    }
    return tail;
}

void rate_healthy(LevelDetection& level, const Threshold& threshold, Alarm alarm,
                  const DetectionRequest& request) {
    const double confidence = request.confidence;
    const auto known = [&](long alarms, long tested) {
        return rate_of(threshold, alarm, request.false_alarm_rate, alarms, tested, confidence);
    };
    level.threshold_rate = known(0, 0).bounds;
    level.healthy_rate = kNan;
    level.healthy_rate_bounds = level.expected_rate = {kNan, kNan};
    if (std::isnan(level.threshold)) {
        return;
    }
    const DetectionCell* healthy = healthy_cell(level);
    const long alarms = healthy != nullptr ? healthy->detected : 0;
    const long tested = healthy != nullptr ? healthy->tested : 0;
    if (tied(level, request)) {
        level.threshold_rate.lower = 0.0;
        const long k = tested > 0 ? alarms : level.threshold_alarms;
        const long n = tested > 0 ? tested : level.threshold_sample;
        level.healthy_rate = static_cast<double>(k) / static_cast<double>(n);
        level.healthy_rate_bounds = clopper_pearson_interval(k, n, confidence);
        return;
    }
    const HealthyRate rate = known(alarms, tested);
    level.healthy_rate = rate.rate;
    level.healthy_rate_bounds = rate.bounds;
    if (!level.tail && !level.importance_sampled) {
        level.expected_rate =
            expected_rate_interval(level.threshold_sample, alarms, tested, confidence);
    }
}

// Warnings for a threshold beyond its sample or from importance sampling.
void warn_of_tail(const LevelDetection& level, const DetectionRequest& request,
                  std::vector<std::string>& warnings) {
    if (level.tail && !level.tail->steady) {
        warnings.push_back(fmt::format(
            "noise level {:g}: the extrapolated threshold depends on how many extreme healthy "
            "values are fitted; the generalised Pareto distribution does not fit the tail; do not "
            "use this threshold",
            level.noise_level));
    }
    const DetectionCell* healthy = healthy_cell(level);
    if (healthy != nullptr && healthy->tested > 0 &&
        !(clopper_pearson_interval(healthy->detected, healthy->tested, request.confidence).lower <=
          level.threshold_rate.upper)) {
        warnings.push_back(
            fmt::format("noise level {:g}: {} of {} healthy test records alarm, more than the "
                        "threshold's interval allows",
                        level.noise_level, healthy->detected, healthy->tested));
    }
}

void warn_of_rate(const LevelDetection& level, const DetectionRequest& request,
                  std::vector<std::string>& warnings) {
    const double rate = request.false_alarm_rate;
    if (level.tail || level.importance_sampled) {
        return warn_of_tail(level, request, warnings);
    }
    if (level.threshold_rate.upper > 2.0 * rate) {
        warnings.push_back(fmt::format(
            "noise level {:g}: {} healthy records determine the false-alarm rate of {:g} only to "
            "within [{:.2g}, {:.2g}]; {} are needed for an upper bound of twice the rate",
            level.noise_level, level.threshold_sample, rate, level.threshold_rate.lower,
            level.threshold_rate.upper, sample_for_rate(rate, request.confidence)));
    }
    if (!std::isnan(level.threshold) && tied(level, request)) {
        warnings.push_back(
            fmt::format("noise level {:g}: healthy records equal the threshold, so the feature is "
                        "constant or nearly so; the false-alarm rate is below {:g}",
                        level.noise_level, rate));
        return;
    }
    // Confidence such that the warning appears by chance in one of a thousand tables, not in one of
    // twenty.
    constexpr double kSurprising = 0.999;
    const DetectionCell* healthy = healthy_cell(level);
    if (healthy == nullptr || std::isnan(level.threshold)) {
        return;
    }
    const Interval expected = expected_rate_interval(level.threshold_sample, healthy->detected,
                                                     healthy->tested, kSurprising);
    if (expected.lower > rate || expected.upper < rate) {
        warnings.push_back(
            fmt::format("noise level {:g}: {} of {} healthy test records alarm, which does not "
                        "agree with a false-alarm rate of {:g} even within the threshold's "
                        "uncertainty (expected rate in [{:.2g}, {:.2g}])",
                        level.noise_level, healthy->detected, healthy->tested, rate, expected.lower,
                        expected.upper));
    }
}

void warn(const LevelDetection& level, std::size_t healthy, double rate,
          std::vector<std::string>& warnings) {
    if (std::isnan(level.threshold)) {
        const bool tied_tail = tail_reaches(level.threshold_sample, rate);
        warnings.push_back(
            fmt::format("noise level {:g}: no threshold, because {} healthy records are too few "
                        "for a false-alarm rate of {:g}{}; at least {} are needed",
                        level.noise_level, level.threshold_sample, rate,
                        tied_tail ? ", and the most extreme are equal" : "",
                        tied_tail ? sample_for_threshold(rate)
                                  : std::min(sample_for_threshold(rate), sample_for_tail(rate))));
    }
    const long without = static_cast<long>(healthy) - level.threshold_sample;
    if (without > 0) {
        warnings.push_back(
            fmt::format("noise level {:g}: {} of {} healthy records have no value and are not used "
                        "for the threshold",
                        level.noise_level, without, healthy));
    }
}

// True if all values equal to the threshold belong to one gearbox. Noise-free records of one
// gearbox are equal, which does not make the feature a constant.
bool tied_within_one(std::span<const double> values, std::span<const std::size_t> gearbox,
                     double threshold) {
    std::set<std::size_t> tied;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (values[i] == threshold) {
            tied.insert(gearbox[i]);
        }
    }
    return tied.size() == 1;
}

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

FeatureDetection detect(const std::string& feature, Alarm alarm, const FeatureSample& healthy,
                        const FeatureSample& test, const DetectionRequest& request) {
    const std::size_t levels = request.noise_levels.size();
    check_shapes(healthy, levels, "healthy");
    check_shapes(test, levels, "graded");
    check_request(request);
    FeatureDetection result;
    result.feature = feature;
    result.alarm = alarm;
    const std::vector<std::size_t> group = groups_of(test.fault_size, request.groups);
    const std::span<const std::size_t> none;
    for (std::size_t n = 0; n < levels; ++n) {
        LevelDetection level;
        level.noise_level = request.noise_levels[n];
        const std::vector<double> sample = every_nth(healthy.values, n, levels);
        const HealthyThresholds thresholds(
            {sample, healthy.weights.empty() ? none : healthy.gearbox, healthy.weights}, alarm);
        const Threshold threshold = thresholds.at(request.false_alarm_rate, request.confidence);
        level.threshold = threshold.value;
        level.threshold_sample = threshold.sample;
        level.threshold_alarms = threshold.alarms;
        level.healthy_median = finite_median(thresholds.plain());
        if (threshold.tail) {
            level.tail = tail_threshold(thresholds.sorted(), alarm, threshold, request);
        }
        if (threshold.importance_sampled) {
            level.importance_sampled = {
                threshold.gearboxes, threshold.importance_sampled->contributing,
                1.0 / (request.false_alarm_rate * static_cast<double>(threshold.gearboxes))};
        }
        level.cells.resize(request.groups.size());
        for (std::size_t g = 0; g < request.groups.size(); ++g) {
            level.cells[g].size = request.groups[g];
        }
        for (std::size_t i = 0; i < group.size(); ++i) {
            if (group[i] != kNoGroup) {
                count(level.cells[group[i]], test.values[i * levels + n], level.threshold, alarm);
            }
        }
        for (DetectionCell& cell : level.cells) {
            rate(cell, !std::isnan(level.threshold), request.confidence);
        }
        rate_healthy(level, threshold, alarm, request);
        warn(level, level.importance_sampled ? sample.size() : thresholds.plain().size(),
             request.false_alarm_rate, result.warnings);
        warn_of_rate(level, request, result.warnings);
        result.levels.push_back(std::move(level));
    }
    if (const auto outside = std::count(group.begin(), group.end(), kNoGroup); outside > 0) {
        result.warnings.push_back(fmt::format(
            "{} of {} gearboxes have a fault size outside all size groups and are not counted",
            outside, group.size()));
    }
    return result;
}

FeatureDetection detect_clustered(const std::string& feature, Alarm alarm,
                                  const FeatureSample& healthy,
                                  std::span<const std::size_t> gearbox, const FeatureSample& test,
                                  const DetectionRequest& request) {
    FeatureDetection result = detect(feature, alarm, healthy, test, request);
    const std::size_t count = std::set<std::size_t>(gearbox.begin(), gearbox.end()).size();
    if (count == gearbox.size() || !healthy.weights.empty()) {
        return result;
    }
    const std::size_t levels = request.noise_levels.size();
    for (std::size_t n = 0; n < levels; ++n) {
        LevelDetection& level = result.levels[n];
        if (std::isnan(level.threshold)) {
            continue;
        }
        const std::vector<double> values = every_nth(healthy.values, n, levels);
        if (tied_within_one(values, gearbox, level.threshold)) {
            const std::string tie = fmt::format(
                "noise level {:g}: healthy records equal the threshold", level.noise_level);
            std::erase_if(result.warnings,
                          [&](const std::string& warning) { return warning.starts_with(tie); });
        }
        const Interval independent = level.threshold_rate;
        const Interval clustered =
            level.tail ? Interval{kNan, kNan}
                       : clustered_rate_interval(values, gearbox, alarm, level.threshold,
                                                 request.false_alarm_rate, request.confidence);
        // Never narrower than the interval of independent values.
        level.threshold_rate = {std::min(independent.lower, clustered.lower),
                                std::max(independent.upper, clustered.upper)};
        const bool tested = !level.cells.empty() && level.cells.front().size.high == 0.0 &&
                            level.cells.front().tested > 0;
        if (level.tail) {
            level.threshold_rate = {kNan, kNan};
        }
        Interval& bounds = level.healthy_rate_bounds;
        bounds = tested ? Interval{std::min(bounds.lower, level.threshold_rate.lower),
                                   std::max(bounds.upper, level.threshold_rate.upper)}
                        : level.threshold_rate;
        if (!level.tail && level.threshold_rate.upper <= 2.0 * request.false_alarm_rate) {
            continue;
        }
        result.warnings.push_back(
            level.tail
                ? fmt::format("noise level {:g}: {} healthy records come from only {} gearboxes, "
                              "so the false-alarm rate of the extrapolated threshold is unknown",
                              level.noise_level, level.threshold_sample, count)
                : fmt::format(
                      "noise level {:g}: {} healthy records come from only {} gearboxes, so the "
                      "false-alarm rate of {:g} is known only to be below {:.2g}",
                      level.noise_level, level.threshold_sample, count, request.false_alarm_rate,
                      level.threshold_rate.upper));
    }
    // Removes the warnings that assume independent values.
    std::erase_if(result.warnings, [](const std::string& warning) {
        return warning.find("healthy records determine the false-alarm rate") != std::string::npos;
    });
    return result;
}

std::optional<SizeGroup> reliable_size(const LevelDetection& level, double pd) {
    std::optional<SizeGroup> size;
    for (auto cell = level.cells.rbegin(); cell != level.cells.rend(); ++cell) {
        if (cell->size.high <= 0.0 || !(cell->lower >= pd)) {
            break;
        }
        size = cell->size;
    }
    return size;
}

long hits_in_a_row(double pd, double confidence) {
    return static_cast<long>(std::ceil(std::log1p(-confidence) / std::log(pd) - 1e-9));
}

double size_beyond_misses(std::span<const double> sizes, std::span<const int> hit, double pd,
                          double confidence) {
    double missed = 0.0;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        missed = hit[i] == 0 ? std::max(missed, sizes[i]) : missed;
    }
    std::vector<double> beyond;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        if (hit[i] == 1 && sizes[i] > missed) {
            beyond.push_back(sizes[i]);
        }
    }
    const auto last = static_cast<std::size_t>(hits_in_a_row(pd, confidence)) - 1;
    if (beyond.size() <= last) {
        return kNan;
    }
    std::nth_element(beyond.begin(), beyond.begin() + static_cast<std::ptrdiff_t>(last),
                     beyond.end());
    return beyond[last];
}

double demonstrated_size(const LevelDetection& level, std::span<const double> sizes,
                         std::span<const int> hit, double pd, double confidence) {
    const double single = size_beyond_misses(sizes, hit, pd, 1.0 - 0.5 * (1.0 - confidence));
    const auto group = reliable_size(level, pd);
    return group ? std::fmin(group->high, single) : single;
}

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
