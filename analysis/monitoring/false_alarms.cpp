#include "analysis/monitoring/false_alarms.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "analysis/detection/threshold.hpp"
#include "analysis/statistics/distributions.hpp"
#include "features/statistics/signal_statistics.hpp"
#include "machine/contracts.hpp"

namespace gearpod::analysis {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Sum {
    long records = 0;
    double hours = 0.0;
};

Sum sum_of(std::span<const HealthyLife> lives) {
    Sum sum;
    for (const HealthyLife& life : lives) {
        sum.records += std::count_if(life.values.begin(), life.values.end(),
                                     [](double value) { return !std::isnan(value); });
        sum.hours += life.hours;
    }
    return sum;
}

struct Counted {
    long alarms = 0;
    double largest_quiet = -kInfinity;
};

Counted count(const Detector& detector, std::span<const HealthyLife> lives, double threshold) {
    Counted counted;
    for (const HealthyLife& life : lives) {
        const DetectorAlarms seen = detector_alarms(detector, life.values, threshold);
        counted.alarms += static_cast<long>(seen.alarms.size());
        counted.largest_quiet = std::max(counted.largest_quiet, seen.largest_quiet);
    }
    return counted;
}

// Smallest statistic of these lives that leaves at most `most` alarms, by bisection. Alarm counts
// change only at values of the statistic: the largest one without an alarm below a threshold leaves
// the same alarms as that threshold.
double smallest_threshold(const Detector& detector, std::span<const HealthyLife> lives, long most) {
    double high = count(detector, lives, kInfinity).largest_quiet, low = -kInfinity, step = 1.0;
    while (std::isfinite(high)) {
        const bool bracketed = std::isfinite(low);
        const Counted below = count(detector, lives, std::nextafter(high, -kInfinity));
        if (below.alarms > most || !std::isfinite(below.largest_quiet)) {
            break;
        }
        high = below.largest_quiet;
        const double lower = bracketed ? low + 0.5 * (high - low) : high - step;
        step *= 2.0;
        if (bracketed && lower <= low) {
            break;
        }
        const Counted there = count(detector, lives, lower);
        if (there.alarms > most) {
            low = lower;
        } else if (std::isfinite(there.largest_quiet)) {
            high = there.largest_quiet;
        }
    }
    return high;
}

// Overdispersion of the alarm counts per life relative to independent alarms, whose variance equals
// the mean.
struct Dispersion {
    double ratio = 1.0;    // variance relative to that of independent alarms, at least 1
    double cluster = 1.0;  // alarms that one more life may add: third moment over the second
    // Degrees of freedom of the ratio, few where few lives determine the variance: F. E.
    // Satterthwaite, Biometrics Bulletin 2 (1946), 110-114.
    double freedom = std::numeric_limits<double>::infinity();
};

Dispersion dispersion_of(const std::vector<long>& alarms, std::span<const HealthyLife> lives,
                         double rate) {
    const auto n = static_cast<double>(lives.size());
    double squares = 0.0, cubes = 0.0, fourths = 0.0, expected = 0.0, of_independent = 0.0;
    for (std::size_t i = 0; i < lives.size(); ++i) {
        const double mean = rate * lives[i].hours;
        const double away = static_cast<double>(alarms[i]) - mean;
        squares += away * away;
        cubes += away * away * away;
        fourths += away * away * away * away;
        expected += mean;
        of_independent += mean + 2.0 * mean * mean;
    }
    const double ratio = expected > 0.0 && n > 1.0 ? squares / expected * n / (n - 1.0) : 1.0;
    if (ratio <= 1.0 + 1e-9) {
        return {};
    }
    // The scatter of independent alarms themselves is not uncertainty of the ratio.
    const double scatter = fourths - squares * squares / n - of_independent;
    return {ratio, std::max(ratio, cubes / squares),
            scatter > 0.0 ? std::clamp(2.0 * squares * squares / scatter, 1.0, n - 1.0) : n - 1.0};
}

// Bounds of the mean of a count, M. P. Fay, E. J. Feuer, Statistics in Medicine 16 (1997), 791-801:
// gamma distributions with the count's mean and variance, with one more cluster for the upper
// bound. For independent alarms these are F. Garwood's bounds, Biometrika 28 (1936), 437-442.
Interval count_bounds(double alarms, const Dispersion& dispersion, double tail) {
    const double variance = dispersion.ratio * alarms;
    const double more = alarms + dispersion.cluster;
    const double more_variance = variance + dispersion.cluster * dispersion.cluster;
    return {alarms > 0.0 ? gamma_quantile(alarms / dispersion.ratio, dispersion.ratio, tail) : 0.0,
            gamma_upper_quantile(more * more / more_variance, more_variance / more, tail)};
}

// Tail probability of the normal quantile that equals the quantile of Student's t with the given
// degrees of freedom at the given confidence.
double tail_of(double confidence, double freedom) {
    const double tail = 0.5 * (1.0 - confidence);
    if (!std::isfinite(freedom)) {
        return tail;
    }
    return normal_cdf(student_quantile(freedom, tail));
}

}  // namespace

MonitorThreshold monitor_threshold(const Detector& detector, std::span<const HealthyLife> lives,
                                   double per_1000_h) {
    const auto [records, hours] = sum_of(lives);
    MonitorThreshold threshold;
    threshold.records = records;
    threshold.hours = hours;
    if (records == 0 || !(hours > 0.0)) {
        threshold.least_per_1000_h = kInfinity;
        return threshold;
    }
    const double hours_a_record = hours / static_cast<double>(records);
    threshold.least_per_1000_h = 1000.0 / (hours_a_record * static_cast<double>(records + 1));
    const double rate = std::min(1.0, per_1000_h * hours_a_record / 1000.0);
    const long rank = threshold_rank(records, rate);
    if (rank > records) {
        return threshold;
    }
    const double value = smallest_threshold(detector, lives, records - rank);
    if (!std::isfinite(value)) {
        return threshold;  // no record has a statistic
    }
    threshold.value = value;
    threshold.alarms = count(detector, lives, threshold.value).alarms;
    return threshold;
}

FalseAlarms false_alarms(const Detector& detector, std::span<const HealthyLife> lives,
                         double threshold, double confidence) {
    FalseAlarms result;
    const auto [records, hours] = sum_of(lives);
    result.records = records;
    result.hours = hours;
    if (!(hours > 0.0) || std::isnan(threshold)) {
        return result;
    }
    std::vector<long> alarms;
    for (const HealthyLife& life : lives) {
        alarms.push_back(
            static_cast<long>(detector_alarms(detector, life.values, threshold).alarms.size()));
    }
    result.alarms = std::accumulate(alarms.begin(), alarms.end(), 0L);
    const double rate = static_cast<double>(result.alarms) / hours;
    result.per_1000_h = 1000.0 * rate;
    const Dispersion dispersion = dispersion_of(alarms, lives, rate);
    result.dispersion = dispersion.ratio;
    result.tail = tail_of(confidence, dispersion.freedom);
    const Interval counts =
        count_bounds(static_cast<double>(result.alarms), dispersion, result.tail);
    result.bounds = {1000.0 * counts.lower / hours, 1000.0 * counts.upper / hours};
    return result;
}

Interval expected_per_1000_h(const MonitorThreshold& threshold, const FalseAlarms& seen) {
    if (!(seen.hours > 0.0) || std::isnan(threshold.value)) {
        return {kNan, kNan};
    }
    const auto independent = [&](long count) {
        return std::lround(static_cast<double>(count) / seen.dispersion);
    };
    const Interval rates =
        expected_rate_interval(independent(threshold.records), independent(seen.alarms),
                               independent(seen.records), 1.0 - 2.0 * seen.tail);
    const double scale = 1000.0 * static_cast<double>(seen.records) / seen.hours;
    return {rates.lower * scale, rates.upper * scale};
}

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
