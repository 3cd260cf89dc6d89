#include "analysis/detection/threshold.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "analysis/statistics/distributions.hpp"
#include "analysis/statistics/interval.hpp"

namespace gearpod::analysis {

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

Threshold alarm_threshold(std::vector<double> healthy, Alarm alarm, double false_alarm_rate) {
    return SortedSample(std::move(healthy), alarm).threshold(false_alarm_rate);
}

SortedSample::SortedSample(std::vector<double> healthy, Alarm alarm)
    : alarm_(alarm), ascending_(std::move(healthy)) {
    std::erase_if(ascending_, [](double value) { return !std::isfinite(value); });
    for (double& value : ascending_) {
        value *= alarm_sign(alarm);
    }
    std::sort(ascending_.begin(), ascending_.end());
}

std::span<const double> SortedSample::largest(long exceedances) const {
    const auto kept = static_cast<std::size_t>(std::min(size(), exceedances + 1));
    return std::span(ascending_).last(kept);
}

const TailFit& SortedSample::tail() const {
    if (!tail_) {
        tail_.emplace(largest(exceedances_of(size())), size());
    }
    return *tail_;
}

Threshold SortedSample::threshold(double false_alarm_rate) const {
    Threshold threshold;
    threshold.sample = size();
    threshold.value = kNan;
    const long rank = threshold_rank(size(), false_alarm_rate);
    if (rank <= size()) {
        threshold.value = alarm_sign(alarm_) * ascending_[static_cast<std::size_t>(rank - 1)];
    } else if (tail_reaches(size(), false_alarm_rate) && tail().refusal().empty()) {
        threshold.value = alarm_sign(alarm_) * tail().threshold(false_alarm_rate);
        threshold.tail = tail();
    }
    threshold.alarms = std::count_if(ascending_.begin(), ascending_.end(), [&](double value) {
        return is_alarm(alarm_sign(alarm_) * value, threshold.value, alarm_);
    });
    return threshold;
}

Interval SortedSample::value_bounds(double false_alarm_rate, double confidence) const {
    constexpr double kOpen = std::numeric_limits<double>::infinity();
    const double tail_share = 0.5 * (1.0 - confidence);
    const long low = rank_within(size(), false_alarm_rate, tail_share, true),
               high = rank_within(size(), false_alarm_rate, tail_share, false);
    Interval values{low < 1 ? -kOpen : ascending_[static_cast<std::size_t>(low - 1)],
                    high > size() ? kOpen : ascending_[static_cast<std::size_t>(high - 1)]};
    if (high > size() && tail_reaches(size(), false_alarm_rate) && tail().refusal().empty()) {
        values = tail().threshold_interval(false_alarm_rate, confidence);
    }
    return alarm_ == Alarm::high ? values : Interval{-values.upper, -values.lower};
}

}  // namespace gearpod::analysis
