#include "analysis/monitoring/false_alarms.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <numeric>
#include <random>
#include <utility>

#include "analysis/detection/threshold.hpp"
#include "analysis/statistics/distributions.hpp"
#include "features/statistics/signal_statistics.hpp"

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

namespace {

constexpr std::size_t kLeastInPart = 5;

bool accumulates(const Detector& detector) {
    return !std::holds_alternative<SingleRule>(detector.rule) &&
           !std::holds_alternative<MOfNRule>(detector.rule);
}

// Detector on the records of one gearbox.
class RecordDetector {
  public:
    RecordDetector(const Detector& detector, const RecordThreshold& threshold)
        : state_(detector),
          threshold_(threshold),
          two_sided_(detector.two_sided),
          accumulates_(accumulates(detector)) {}

    // -infinity: no statistic yet.
    double next(double value) {
        const double distance = (value - threshold_.centre) / threshold_.scale,
                     beyond = (two_sided_ ? std::abs(distance) : distance) - threshold_.band;
        beyond_ = std::clamp(beyond, two_sided_ ? 0.0 : -threshold_.most, threshold_.most);
        beyond_ = two_sided_ ? std::copysign(beyond_, distance) : beyond_;
        return state_.next(beyond_);
    }
    bool alarms(double value) {
        return next(value) > threshold_.value &&
               (!accumulates_ || beyond_ > 0.0 || (two_sided_ && beyond_ < 0.0));
    }

  private:
    DetectorState state_;
    const RecordThreshold& threshold_;
    bool two_sided_, accumulates_;
    double beyond_ = 0.0;
};

std::vector<double> values_of(std::span<const TimedValue> records) {
    std::vector<double> values;
    std::ranges::transform(records, std::back_inserter(values), &TimedValue::value);
    return values;
}

std::vector<double> all_values(std::span<const HealthyRecords> gearboxes) {
    std::vector<double> all;
    for (const HealthyRecords& records : gearboxes) {
        std::ranges::transform(records, std::back_inserter(all), &TimedValue::value);
    }
    return all;
}

// Ends of the parts; of too few records, only of all.
std::vector<std::size_t> part_ends(std::span<const TimedValue> records) {
    constexpr std::size_t kParts = 3, kMostSessions = 4;
    const std::size_t count = records.size();
    if (count < kParts * kLeastInPart) {
        return {count};
    }
    double longest = 0.0;
    for (std::size_t i = 1; i < count; ++i) {
        longest = std::max(longest, records[i].time - records[i - 1].time);
    }
    std::vector<std::size_t> ends;
    std::size_t begin = 0, shortest = count;
    for (std::size_t i = 1; i <= count; ++i) {
        if (i == count || records[i].time - records[i - 1].time > 0.1 * longest) {
            shortest = std::min(shortest, i - begin);
            begin = i;
            ends.push_back(i);
        }
    }
    return shortest >= kLeastInPart && ends.size() >= kParts && ends.size() <= kMostSessions
               ? ends
               : std::vector{count / 3, 2 * count / 3, count};
}

double mean_of(std::span<const TimedValue> records) {
    double sum = 0.0;
    for (const TimedValue& record : records) {
        sum += record.value;
    }
    return sum / static_cast<double>(records.size());
}

// P(T > t) of Student's distribution, fast enough for every record: M. Abramowitz, I. A. Stegun,
// Handbook of Mathematical Functions (1964), 26.7.3 and 26.7.4.
double student_upper_tail(double t, int freedom) {
    const double sine = t / std::sqrt(freedom + t * t), square = 1.0 - sine * sine;
    const bool odd = freedom % 2 != 0;
    double term = odd ? std::sqrt(square) : 1.0, series = freedom == 1 ? 0.0 : term;
    for (int j = odd ? 3 : 2; j < freedom; j += 2) {
        term *= (j - 1.0) / j * square;
        series += term;
    }
    return 0.5 - (odd ? (std::asin(sine) + sine * series) / std::numbers::pi : 0.5 * sine * series);
}

// Levels of the parts of each gearbox's records.
struct Levels {
    std::vector<double> about;  // values about the level of their part, at that of their gearbox
    double drift = 0.0;         // standard deviation of the level of further records
    int freedom = 0;            // of the drift

    explicit Levels(std::span<const HealthyRecords> gearboxes) {
        double squares = 0.0;
        for (const std::span<const TimedValue> records : gearboxes) {
            const std::vector<std::size_t> ends = part_ends(records);
            const double mean = mean_of(records), parts = static_cast<double>(ends.size());
            std::size_t begin = 0;
            for (const std::size_t end : ends) {
                const auto part = records.subspan(begin, end - begin);
                const double away = ends.size() == 1 ? 0.0 : mean_of(part) - mean;
                squares += away * away * (1.0 + 1.0 / parts);
                for (const TimedValue& record : part) {
                    about.push_back(record.value - away);
                }
                begin = end;
            }
            freedom += static_cast<int>(ends.size()) - 1;
        }
        drift = freedom > 0 ? std::sqrt(squares / freedom) : 0.0;
    }
    // Expected number of values above the threshold; more than 20 degrees of freedom change little.
    double above(double threshold) const {
        double sum = 0.0;
        for (const double value : about) {
            sum += student_upper_tail((threshold - value) / drift, std::min(freedom, 20));
        }
        return sum;
    }
};

}  // namespace

RecordThreshold record_threshold(const Detector& detector, std::span<const HealthyRecords> healthy,
                                 double rate) {
    RecordThreshold threshold;
    std::vector<double> values = all_values(healthy);
    if (accumulates(detector) && !values.empty()) {
        const Levels levels(healthy);
        std::ranges::sort(values);
        const auto quantile = [&](double share) {
            return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
        };
        threshold.drift = levels.drift;
        threshold.centre = quantile(0.5);
        const double middle = 0.5 * (quantile(0.84) - quantile(0.16)),
                     all = 0.5 * (values.back() - values.front());
        if (all > 0.0) {
            threshold.scale = middle > 0.0 ? middle : all;
            threshold.most = 4.0 * all / threshold.scale;
            const double possible = std::max(rate, smallest_rate(static_cast<long>(values.size())));
            const double tail = detector.two_sided ? 0.5 * possible : possible;
            threshold.band = threshold.drift > 0.0 ? -student_quantile(levels.freedom, tail) *
                                                         threshold.drift / threshold.scale
                                                   : 0.0;
        }
    }
    std::vector<HealthyRecords> statistics;
    for (const HealthyRecords& records : healthy) {
        RecordDetector state(detector, threshold);
        statistics.emplace_back();
        for (const TimedValue& record : records) {
            if (const double statistic = state.next(record.value); std::isfinite(statistic)) {
                statistics.back().push_back({record.time, statistic});
            }
        }
    }
    std::vector<double> ordered = all_values(statistics);
    threshold.records = static_cast<long>(ordered.size());
    if (ordered.empty()) {
        return threshold;
    }
    std::ranges::sort(ordered);
    threshold.rate = std::max(rate, smallest_rate(threshold.records));
    const long rank = threshold_rank(threshold.records, threshold.rate);
    threshold.value = ordered[static_cast<std::size_t>(rank - 1)];
    const Levels levels(accumulates(detector) ? std::span<const HealthyRecords>() : statistics);
    if (levels.drift > 0.0) {
        threshold.drift = levels.drift;
        const auto most = static_cast<double>(threshold.records - rank + 1);
        double low = ordered.front() - levels.drift, high = ordered.back(), step = levels.drift;
        while (levels.above(high) >= most) {
            low = high;
            high += step;
            step *= 2.0;
        }
        for (int halving = 0; halving < 50; ++halving) {
            const double middle = 0.5 * (low + high);
            (levels.above(middle) >= most ? low : high) = middle;
        }
        threshold.value = std::max(threshold.value, high);
    }
    for (const HealthyRecords& records : healthy) {
        threshold.alarms +=
            std::ranges::count(record_alarms(detector, values_of(records), threshold), true);
    }
    return threshold;
}

std::vector<std::optional<bool>> record_alarms(const Detector& detector,
                                               std::span<const double> values,
                                               const RecordThreshold& threshold) {
    std::vector<std::optional<bool>> alarms(values.size());
    RecordDetector records(detector, threshold);
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!std::isnan(values[i])) {
            alarms[i] = records.alarms(values[i]);
        }
    }
    return alarms;
}

double run_length(const Detector& detector, std::span<const HealthyRecords> healthy,
                  const RecordThreshold& threshold, long longest) {
    constexpr std::size_t kSeries = 101;
    const std::vector<double> values = all_values(healthy);
    std::mt19937_64 engine(1);
    std::vector<double> lengths;
    while (lengths.size() < kSeries && !values.empty()) {
        RecordDetector records(detector, threshold);
        long length = 1;
        while (length <= longest && !records.alarms(values[engine() % values.size()])) {
            ++length;
        }
        lengths.push_back(length > longest ? kInfinity : static_cast<double>(length));
    }
    return features::median(std::move(lengths));
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

HeldOutAlarms held_out_alarms(const Detector& detector, std::span<const HealthyRecords> healthy,
                              double rate, double confidence) {
    std::vector<HealthyRecords> first_halves;
    for (const HealthyRecords& all : healthy) {
        first_halves.emplace_back(all.begin(), all.begin() + static_cast<long>(all.size() / 2));
    }
    const RecordThreshold threshold = record_threshold(detector, first_halves, rate);
    HeldOutAlarms held_out{threshold.rate, 0, 0, {kNan, kNan}};
    for (const HealthyRecords& all : healthy) {
        const auto half = static_cast<long>(all.size() / 2);
        const auto alarms = record_alarms(detector, values_of(all), threshold);
        held_out.alarms += std::count(alarms.begin() + half, alarms.end(), true);
        held_out.records += static_cast<long>(all.size()) - half;
    }
    if (!std::isnan(held_out.rate)) {
        held_out.bounds = clopper_pearson_interval(held_out.alarms, held_out.records, confidence);
    }
    return held_out;
}

}  // namespace gearpod::analysis
