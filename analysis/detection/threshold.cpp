#include "analysis/detection/threshold.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "analysis/statistics/distributions.hpp"
#include "analysis/statistics/interval.hpp"

namespace gearpod::analysis {
namespace {

double order_statistic(std::vector<double>& values, long rank, Alarm alarm) {
    const auto place = values.begin() + (rank - 1);
    if (alarm == Alarm::high) {
        std::nth_element(values.begin(), place, values.end());
    } else {
        std::nth_element(values.begin(), place, values.end(), std::greater<>());
    }
    return *place;
}

}  // namespace

Threshold alarm_threshold(std::vector<double> healthy, Alarm alarm, double false_alarm_rate) {
    std::erase_if(healthy, [](double value) { return !std::isfinite(value); });
    Threshold threshold;
    threshold.sample = static_cast<long>(healthy.size());
    threshold.value = kNan;
    const long rank = threshold_rank(threshold.sample, false_alarm_rate);
    if (rank <= threshold.sample) {
        threshold.value = order_statistic(healthy, rank, alarm);
    } else if (tail_reaches(threshold.sample, false_alarm_rate)) {
        TailFit tail(largest_values(healthy, alarm, exceedances_of(threshold.sample)),
                     threshold.sample);
        if (tail.refusal().empty()) {
            threshold.value = alarm_sign(alarm) * tail.threshold(false_alarm_rate);
            threshold.tail = std::move(tail);
        }
    }
    threshold.alarms = std::count_if(healthy.begin(), healthy.end(), [&](double value) {
        return is_alarm(value, threshold.value, alarm);
    });
    return threshold;
}

HealthyRate rate_of(const Threshold& threshold, Alarm alarm, double false_alarm_rate, long alarms,
                    long tested, double confidence) {
    if (threshold.importance_sampled) {
        return {false_alarm_rate, threshold.importance_sampled->rate};
    }
    return threshold.tail
               ? threshold.tail->rate(alarm_sign(alarm) * threshold.value, alarms, tested,
                                      confidence)
               : healthy_rate(threshold.sample, false_alarm_rate, alarms, tested, confidence);
}

namespace {

// Smallest rank of a healthy value for which, with the confidence 1 - tail, fewer than `rate` of
// all gearboxes lie beyond that value. With `below`, the largest rank for which more than `rate`
// do. n + 1 or 0 if there is none.
long rank_within(long sample, double rate, double tail, bool below) {
    long low = 0, high = sample + 1;
    while (high - low > 1) {
        const long middle = low + (high - low) / 2;
        // Probability that at most `rate` of all gearboxes lie beyond the value of rank `middle`.
        // It increases with the rank.
        const double p =
            beta_cdf(static_cast<double>(sample + 1 - middle), static_cast<double>(middle), rate);
        ((below ? p <= tail : p < 1.0 - tail) ? low : high) = middle;
    }
    return below ? low : high;
}

}  // namespace

Interval threshold_interval(const std::vector<double>& healthy, Alarm alarm,
                            double false_alarm_rate, double confidence) {
    constexpr double kOpen = std::numeric_limits<double>::infinity();
    const std::vector<double> ascending =
        largest_values(healthy, alarm, static_cast<long>(healthy.size()));
    const auto sample = static_cast<long>(ascending.size());
    const double tail = 0.5 * (1.0 - confidence);
    const long low = rank_within(sample, false_alarm_rate, tail, true),
               high = rank_within(sample, false_alarm_rate, tail, false);
    Interval values{low < 1 ? -kOpen : ascending[static_cast<std::size_t>(low - 1)],
                    high > sample ? kOpen : ascending[static_cast<std::size_t>(high - 1)]};
    if (high > sample && tail_reaches(sample, false_alarm_rate)) {
        const TailFit fit(largest_values(healthy, alarm, exceedances_of(sample)), sample);
        if (fit.refusal().empty()) {
            values = fit.threshold_interval(false_alarm_rate, confidence);
        }
    }
    return alarm == Alarm::high ? values : Interval{-values.upper, -values.lower};
}

std::vector<double> largest_values(std::vector<double> healthy, Alarm alarm, long exceedances) {
    std::erase_if(healthy, [](double value) { return !std::isfinite(value); });
    for (double& value : healthy) {
        value *= alarm_sign(alarm);
    }
    const auto kept = std::min(healthy.size(), static_cast<std::size_t>(exceedances) + 1);
    std::partial_sort(healthy.begin(), healthy.begin() + static_cast<std::ptrdiff_t>(kept),
                      healthy.end(), std::greater<>());
    healthy.resize(kept);
    std::reverse(healthy.begin(), healthy.end());
    return healthy;
}

}  // namespace gearpod::analysis
