#include "analysis/detection/healthy_thresholds.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/detection/clustered_rate.hpp"

namespace gearpod::analysis {
namespace {

// All values, or the first of each gearbox of an importance-sampled sample.
std::vector<double> plain_values(const HealthyValues& sample) {
    std::vector<double> plain;
    for (std::size_t i = 0; i < sample.values.size(); ++i) {
        if (sample.weights.empty() || i == 0 || sample.gearbox[i] != sample.gearbox[i - 1]) {
            plain.push_back(sample.values[i]);
        }
    }
    return plain;
}

}  // namespace

bool HealthyValues::clustered() const {
    std::vector<std::size_t> sorted(gearbox.begin(), gearbox.end());
    std::sort(sorted.begin(), sorted.end());
    return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
}

HealthyThresholds::HealthyThresholds(const HealthyValues& sample, Alarm alarm)
    : alarm_(alarm), plain_(plain_values(sample)), sorted_(plain_, alarm) {
    if (!sample.weights.empty()) {
        importance_sample_.emplace(sample.values, sample.weights, sample.gearbox, alarm);
    } else if (sample.clustered()) {
        gearbox_.assign(sample.gearbox.begin(), sample.gearbox.end());
    }
}

Threshold HealthyThresholds::at(double false_alarm_rate, double confidence) const {
    if (const auto estimate = importance_sample_
                                  ? importance_sample_->threshold(false_alarm_rate, confidence)
                                  : std::nullopt) {
        Threshold threshold;
        threshold.value = estimate->threshold;
        threshold.sample = importance_sample_->records();
        threshold.alarms = estimate->alarms;
        threshold.gearboxes = importance_sample_->gearboxes();
        threshold.importance_sampled = estimate;
        return threshold;
    }
    Threshold threshold = sorted_.threshold(false_alarm_rate);
    if (!gearbox_.empty() && threshold.tail) {
        threshold.value = kNan;
        threshold.tail.reset();
    }
    return threshold;
}

Interval HealthyThresholds::value_bounds(const Threshold& threshold, double false_alarm_rate,
                                         double confidence) const {
    if (threshold.importance_sampled) {
        return importance_sample_->threshold_interval(false_alarm_rate,
                                                      *threshold.importance_sampled);
    }
    if (gearbox_.empty()) {
        return sorted_.value_bounds(false_alarm_rate, confidence);
    }
    // The true rate of a value is the rate of its rank times the ratio of the interval's bound to
    // the rate.
    const Interval rate = rate_bounds(threshold, false_alarm_rate, confidence);
    const std::vector<double>& ascending = sorted_.ascending();
    const auto value = [&](double bound) {
        const double target = false_alarm_rate * false_alarm_rate / bound;
        const double rank = std::ceil((static_cast<double>(ascending.size()) + 1.0) *
                                      (1.0 - std::min(1.0, target)));
        const double sign = alarm_sign(alarm_);
        return rank > static_cast<double>(ascending.size())
                   ? sign * std::numeric_limits<double>::infinity()
                   : sign * ascending[static_cast<std::size_t>(std::max(1.0, rank)) - 1];
    };
    const Interval values{value(rate.lower), value(rate.upper)};
    return alarm_ == Alarm::high ? values : Interval{values.upper, values.lower};
}

Interval HealthyThresholds::rate_bounds(const Threshold& threshold, double false_alarm_rate,
                                        double confidence) const {
    const Interval own = rate_of(threshold, alarm_, false_alarm_rate, 0, 0, confidence).bounds;
    if (threshold.importance_sampled || gearbox_.empty() || std::isnan(threshold.value)) {
        return own;
    }
    const Interval clustered = clustered_rate_interval(plain_, gearbox_, alarm_, threshold.value,
                                                       false_alarm_rate, confidence);
    return {std::min(own.lower, clustered.lower), std::max(own.upper, clustered.upper)};
}

}  // namespace gearpod::analysis
