#include "analysis/monitoring/sustained_alarms.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/statistics/interval.hpp"
#include "features/statistics/signal_statistics.hpp"
#include "machine/contracts.hpp"

namespace gearpod::analysis {

int SustainedRule::needed() const {
    constexpr double kRounding = 1e-9;
    return std::max(1, static_cast<int>(std::ceil(share * records - kRounding)));
}

std::vector<std::optional<bool>> record_alarms(const Detector& detector,
                                               std::span<const double> values, double threshold) {
    const bool forgets = std::holds_alternative<SingleRule>(detector.rule) ||
                         std::holds_alternative<MOfNRule>(detector.rule);
    std::vector<std::optional<bool>> alarms(values.size());
    DetectorState state(detector);
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (std::isnan(values[i])) {
            continue;
        }
        alarms[i] = state.next(values[i]) > threshold;
        if (*alarms[i] && !forgets) {
            state.reset();
        }
    }
    return alarms;
}

std::vector<SustainedAlarm> sustained_alarms(std::span<const std::optional<bool>> alarms,
                                             const SustainedRule& rule) {
    std::vector<SustainedAlarm> found;
    for (std::size_t i = 0; i < alarms.size(); ++i) {
        if (!alarms[i].value_or(false)) {
            continue;
        }
        int seen = 0, alarmed = 0;
        for (std::size_t next = i + 1; next < alarms.size() && seen < rule.records; ++next) {
            seen += alarms[next].has_value() ? 1 : 0;
            alarmed += alarms[next].value_or(false) ? 1 : 0;
            if (alarmed == rule.needed()) {
                found.push_back({i, next});
                i = next;
                break;
            }
        }
    }
    return found;
}

double smallest_rate(long healthy_records) {
    return 1.0 / static_cast<double>(healthy_records + 1);
}

HeldOutAlarms held_out_alarms(const Detector& detector, std::span<const HealthyLife> lives,
                              double rate, double confidence) {
    std::vector<HealthyLife> setting, tested;
    long records = 0;
    HeldOutAlarms held_out;
    for (const HealthyLife& life : lives) {
        const auto half = life.values.begin() + static_cast<std::ptrdiff_t>(life.values.size() / 2);
        const auto with_value = [](double value) { return !std::isnan(value); };
        const long first = std::count_if(life.values.begin(), half, with_value),
                   second = std::count_if(half, life.values.end(), with_value);
        setting.push_back({{life.values.begin(), half}, static_cast<double>(first)});
        tested.push_back({{half, life.values.end()}, static_cast<double>(second)});
        records += first;
        held_out.records += second;
    }
    if (records == 0 || held_out.records == 0) {
        return held_out;
    }
    held_out.rate = std::max(rate, smallest_rate(records));
    const double threshold = monitor_threshold(detector, setting, 1000.0 * held_out.rate).value;
    if (std::isnan(threshold)) {
        held_out.rate = kNan;
        return held_out;
    }
    for (const HealthyLife& life : tested) {
        held_out.alarms +=
            static_cast<long>(detector_alarms(detector, life.values, threshold).alarms.size());
    }
    held_out.bounds = clopper_pearson_interval(held_out.alarms, held_out.records, confidence);
    return held_out;
}

Drift drift_of(std::span<const double> values) {
    EXPECTS(std::ranges::all_of(values, [](double value) { return std::isfinite(value); }));
    constexpr std::size_t kMost = 1000;
    std::vector<double> used;
    const std::size_t count = std::min(values.size(), kMost);
    for (std::size_t i = 0; i < count; ++i) {
        used.push_back(values[i * values.size() / count]);
    }
    constexpr std::size_t kFewest = 10;
    if (count < kFewest) {
        return {};
    }
    std::vector<double> slopes;
    double score = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t j = i + 1; j < count; ++j) {
            const double rise = used[j] - used[i];
            slopes.push_back(rise / static_cast<double>(j - i));
            score += rise > 0.0 ? 1.0 : rise < 0.0 ? -1.0 : 0.0;
        }
    }
    const auto n = static_cast<double>(count);
    // Variance of the score of independent values without ties, with the correction of continuity.
    const double deviation = std::sqrt(n * (n - 1.0) * (2.0 * n + 5.0) / 18.0);
    const double z = std::max(0.0, std::abs(score) - 1.0) / deviation;
    return {features::median(std::move(slopes)) * (n - 1.0) / features::median(std::move(used)),
            score / (0.5 * n * (n - 1.0)), std::erfc(z / std::sqrt(2.0))};
}

}  // namespace gearpod::analysis
