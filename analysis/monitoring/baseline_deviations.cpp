#include "analysis/monitoring/baseline_deviations.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace gearpod::analysis {
namespace {

// Relative difference that is attributed to rounding.
constexpr double kAlike = 1e-12;

// Baseline: the mean, and a regression line where a condition is given.
struct Baseline {
    double count = 0.0, mean = 0.0, slope = 0.0;
    double at = 0.0, spread = 0.0;  // mean of the condition, and its sum of squares about the mean
    double sd = kNan;               // about the line

    double expected(double condition) const { return mean + slope * (condition - at); }
    // Standard deviation of the prediction of one further value. NaN without a regression line at
    // another condition than the baseline's.
    double prediction_sd(double condition) const {
        const double away = condition - at;
        if (spread == 0.0) {
            return same(condition) ? sd * std::sqrt(1.0 + 1.0 / count) : kNan;
        }
        return sd * std::sqrt(1.0 + 1.0 / count + away * away / spread);
    }
    // True if the condition equals the baseline's mean except for rounding.
    bool same(double condition) const { return std::abs(condition - at) <= kAlike * std::abs(at); }
};

// Learns from those of the first `baseline` records that have a value.
Baseline learn(std::span<const double> values, std::span<const double> condition,
               std::size_t baseline) {
    std::vector<std::size_t> good;
    for (std::size_t i = 0; i < std::min(baseline, values.size()); ++i) {
        if (std::isfinite(values[i]) && (condition.empty() || std::isfinite(condition[i]))) {
            good.push_back(i);
        }
    }
    Baseline baseline_fit;
    if (good.size() < (condition.empty() ? 3U : 4U)) {
        return baseline_fit;
    }
    baseline_fit.count = static_cast<double>(good.size());
    for (const std::size_t i : good) {
        baseline_fit.mean += values[i] / baseline_fit.count;
        baseline_fit.at += condition.empty() ? 0.0 : condition[i] / baseline_fit.count;
    }
    double together = 0.0, squares = 0.0;
    for (const std::size_t i : good) {
        const double away = condition.empty() || baseline_fit.same(condition[i])
                                ? 0.0
                                : condition[i] - baseline_fit.at;
        baseline_fit.spread += away * away;
        together += away * (values[i] - baseline_fit.mean);
    }
    baseline_fit.slope = baseline_fit.spread > 0.0 ? together / baseline_fit.spread : 0.0;
    for (const std::size_t i : good) {
        const double rest =
            values[i] - baseline_fit.expected(condition.empty() ? 0.0 : condition[i]);
        squares += rest * rest;
    }
    // The rounding residue of equal values is not scatter.
    const double least = kAlike * std::abs(baseline_fit.mean);
    const double sd =
        std::sqrt(squares / (baseline_fit.count - (baseline_fit.spread > 0.0 ? 2.0 : 1.0)));
    baseline_fit.sd = sd > least ? sd : kNan;
    return baseline_fit;
}

// Standardised residuals of all records, including the baseline's.
std::vector<double> residuals(std::span<const double> values, std::span<const double> condition,
                              std::size_t baseline, Alarm alarm) {
    const Baseline baseline_fit = learn(values, condition, baseline);
    std::vector<double> all(values.size(), kNan);
    for (std::size_t i = 0; i < values.size() && std::isfinite(baseline_fit.sd); ++i) {
        const double covariate = condition.empty() ? 0.0 : condition[i];
        // Baseline records use the scatter about the line, further ones the scatter of their
        // prediction.
        const double sd = i < baseline ? baseline_fit.sd : baseline_fit.prediction_sd(covariate);
        all[i] = alarm_sign(alarm) * (values[i] - baseline_fit.expected(covariate)) / sd;
    }
    return all;
}

void check(std::size_t values, std::span<const double> condition) {
    if (!condition.empty() && condition.size() != values) {
        throw std::invalid_argument("baseline: needs one condition per value");
    }
}

// Correlation about zero over the records that have both values.
double correlation(std::span<const double> a, std::span<const double> b) {
    double ab = 0.0, aa = 0.0, bb = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (std::isfinite(a[i]) && std::isfinite(b[i])) {
            ab += a[i] * b[i];
            aa += a[i] * a[i];
            bb += b[i] * b[i];
        }
    }
    return aa > 0.0 && bb > 0.0 ? ab / std::sqrt(aa * bb) : 0.0;
}

}  // namespace

std::vector<double> baseline_deviations(std::span<const double> values,
                                        std::span<const double> condition, std::size_t baseline,
                                        Alarm alarm) {
    check(values.size(), condition);
    if (baseline == 0) {
        std::vector<double> all(values.begin(), values.end());
        std::transform(all.begin(), all.end(), all.begin(),
                       [&](double value) { return alarm_sign(alarm) * value; });
        return all;
    }
    std::vector<double> all = residuals(values, condition, baseline, alarm);
    std::fill_n(all.begin(), std::min(baseline, all.size()), kNan);
    return all;
}

std::vector<double> fused_deviations(const std::vector<std::vector<double>>& values,
                                     std::span<const double> condition, std::size_t baseline,
                                     std::span<const Alarm> alarms) {
    std::vector<std::vector<double>> parts;
    for (std::size_t f = 0; f < values.size(); ++f) {
        check(values[f].size(), condition);
        if (values[f].size() != values.front().size()) {
            throw std::invalid_argument("baseline: needs as many values of every feature");
        }
        auto part = residuals(values[f], condition, baseline, alarms[f]);
        if (std::ranges::any_of(part, [](double value) { return !std::isnan(value); })) {
            parts.push_back(std::move(part));
        }
    }
    std::vector<double> sum(values.empty() ? 0 : values.front().size(), kNan);
    double variance = 0.0;
    for (const auto& a : parts) {
        for (const auto& b : parts) {
            variance += correlation(std::span(a).first(std::min(baseline, a.size())),
                                    std::span(b).first(std::min(baseline, b.size())));
        }
    }
    for (std::size_t i = baseline; i < sum.size() && variance > 0.0; ++i) {
        const double total =
            std::accumulate(parts.begin(), parts.end(), 0.0,
                            [&](double so_far, const auto& part) { return so_far + part[i]; });
        sum[i] = total / std::sqrt(variance);
    }
    return sum;
}

}  // namespace gearpod::analysis
