#include "analysis/detection/healthy_thresholds.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "analysis/detection/false_alarm_rate.hpp"
#include "analysis/detection/threshold.hpp"
#include "analysis/statistics/distributions.hpp"
#include "analysis/statistics/rank_statistics.hpp"

namespace gearpod::analysis {
namespace {

struct Gearbox {
    std::vector<double> values;
    double alarms = 0.0;

    double recordings() const { return static_cast<double>(values.size()); }
};
using Gearboxes = std::map<std::size_t, Gearbox>;

struct Totals {
    double gearboxes = 0.0, recordings = 0.0, alarms = 0.0;
};

Totals totals(const Gearboxes& gearboxes) {
    Totals all;
    for (const auto& [number, gearbox] : gearboxes) {
        all.gearboxes += 1.0;
        all.recordings += gearbox.recordings();
        all.alarms += gearbox.alarms;
    }
    return all;
}

// Design effect: variance of the alarms between gearboxes relative to that of as many independent
// recordings.
double design_effect(const Gearboxes& gearboxes) {
    const Totals all = totals(gearboxes);
    const double rate = std::max(0.5, all.alarms) / all.recordings;
    double squares = 0.0;
    for (const auto& [number, gearbox] : gearboxes) {
        const double excess = gearbox.alarms - rate * gearbox.recordings();
        squares += excess * excess;
    }
    const double effect =
        all.gearboxes / (all.gearboxes - 1.0) * squares / (all.recordings * rate * (1.0 - rate));
    return std::clamp(effect, 1.0, all.recordings / all.gearboxes);
}

// Effective number of alarming gearboxes: the number of gearboxes with equal counts that would
// determine the scatter equally well.
double effective_alarming_gearboxes(const Gearboxes& gearboxes) {
    double alarms = 0.0, squares = 0.0;
    for (const auto& [number, gearbox] : gearboxes) {
        alarms += gearbox.alarms;
        squares += gearbox.alarms * gearbox.alarms;
    }
    return squares > 0.0 ? alarms * alarms / squares : 0.0;
}

// Share of the gearboxes in the variance of normal scores, by analysis of variance of the first
// recordings of each (S. R. Searle, G. Casella, C. E. McCulloch, Variance Components (1992),
// section 3.6).
double share_of_gearboxes(const Gearboxes& gearboxes) {
    constexpr std::size_t kMost = 10;
    std::vector<double> values;
    for (const auto& [number, gearbox] : gearboxes) {
        const auto first = gearbox.values.begin();
        values.insert(values.end(), first,
                      first + static_cast<std::ptrdiff_t>(std::min(kMost, gearbox.values.size())));
    }
    const std::vector<double> ranks = midranks(values);
    const auto n = static_cast<double>(values.size()), g = static_cast<double>(gearboxes.size());
    double between = 0.0, within = 0.0, squares = 0.0;
    std::size_t index = 0;
    for (const auto& [number, gearbox] : gearboxes) {
        const std::size_t records = std::min(kMost, gearbox.values.size());
        double sum = 0.0, sum2 = 0.0;
        for (std::size_t i = 0; i < records; ++i, ++index) {
            const double score = -normal_upper_quantile((ranks[index] - 0.5) / n);
            sum += score;
            sum2 += score * score;
        }
        const auto count = static_cast<double>(records);
        between += sum * sum / count;  // the mean of the scores is 0
        within += sum2 - sum * sum / count;
        squares += count * count;
    }
    if (g < 2.0 || n <= g) {
        return 0.0;
    }
    const double each = (n - squares / n) / (g - 1.0);
    const double mean_between = between / (g - 1.0), mean_within = within / (n - g);
    const double variance = std::max(0.0, (mean_between - mean_within) / each);
    return variance > 0.0 ? variance / (variance + mean_within) : 0.0;
}

// Interval from an effective sample size; `scatter_sample`: number of gearboxes that determine the
// scatter.
Interval effective_interval(double recordings, double effect, double scatter_sample, double rate,
                            double tail) {
    const double narrower =
        normal_quantile(1.0 - tail) / student_quantile(scatter_sample - 1.0, 1.0 - tail);
    const double sample = recordings / effect * narrower * narrower + 1.0;
    const double a = sample * rate, b = sample - a;
    return {beta_quantile(a, b, tail), beta_quantile(a, b, 1.0 - tail)};
}

// Interval where alarms are rarer than gearboxes. The scatter between gearboxes is the larger of
// that of normal scores and the observed one. Empty where few gearboxes have the alarms, or where
// they scatter more than normal scores.
std::optional<Interval> rare_interval(const Gearboxes& gearboxes, double rate, double tail) {
    constexpr double kLeastScatterSample = 20.0, kLeastAlarming = 15.0, kAlike = 1.3;
    const Totals all = totals(gearboxes);
    const double others = all.recordings / all.gearboxes - 1.0;
    const double both = both_exceed(rate, share_of_gearboxes(gearboxes));
    const double effect = 1.0 + others * (both - rate * rate) / (rate * (1.0 - rate));
    const double scatter_sample = all.recordings * rate / (1.0 + others * both / rate);
    const double seen = design_effect(gearboxes),
                 alarming_now = effective_alarming_gearboxes(gearboxes);
    if (scatter_sample < kLeastScatterSample || alarming_now < kLeastAlarming ||
        seen > kAlike * effect) {
        return std::nullopt;
    }
    return effective_interval(all.recordings, std::max(seen, effect),
                              std::min(scatter_sample, alarming_now), rate, tail);
}

}  // namespace

Interval clustered_rate_interval(std::span<const double> values,
                                 std::span<const std::size_t> gearbox, Alarm alarm,
                                 double threshold, double false_alarm_rate, double confidence) {
    Gearboxes gearboxes;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (std::isfinite(values[i])) {
            Gearbox& of_row = gearboxes[gearbox[i]];
            of_row.values.push_back(values[i]);
            of_row.alarms += is_alarm(values[i], threshold, alarm) ? 1.0 : 0.0;
        }
    }
    const Totals all = totals(gearboxes);
    const double tail = 0.5 * (1.0 - confidence);
    constexpr double kExpected = 5.0;
    if (all.gearboxes * false_alarm_rate >= kExpected) {
        return effective_interval(all.recordings, design_effect(gearboxes), all.gearboxes,
                                  false_alarm_rate, tail);
    }
    if (const auto rare = rare_interval(gearboxes, false_alarm_rate, tail)) {
        return *rare;
    }
    // Counts all recordings of a gearbox as one: the order statistic is then one of gearboxes. The
    // share beyond it may be below or above the requested rate.
    const double rank = std::ceil(
        static_cast<double>(threshold_rank(std::lround(all.recordings), false_alarm_rate)) /
        all.recordings * all.gearboxes);
    const double a = (all.gearboxes + 1.0) * false_alarm_rate;
    return {beta_quantile(a, all.gearboxes + 1.0 - a, tail),
            beta_quantile(std::max(1.0, all.gearboxes + 1.0 - rank), std::min(rank, all.gearboxes),
                          1.0 - tail)};
}

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
    const Interval independent =
        rate_of(threshold, alarm_, false_alarm_rate, 0, 0, confidence).bounds;
    if (threshold.importance_sampled || gearbox_.empty() || std::isnan(threshold.value)) {
        return independent;
    }
    const Interval clustered = clustered_rate_interval(plain_, gearbox_, alarm_, threshold.value,
                                                       false_alarm_rate, confidence);
    return {std::min(independent.lower, clustered.lower),
            std::max(independent.upper, clustered.upper)};
}

}  // namespace gearpod::analysis
