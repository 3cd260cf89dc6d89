#include "analysis/monitoring/monitor_performance.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <tuple>
#include <utility>

#include "analysis/statistics/distributions.hpp"
#include "analysis/statistics/interval.hpp"

namespace gearpod::analysis {
namespace {

// Order statistic; `values` is not empty and is reordered.
double quantile_of(std::vector<double>& values, double share) {
    const auto middle = values.begin() +
                        static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

std::vector<std::pair<double, double>> sizes_and_values(std::span<const CrackedLife> cracked) {
    std::vector<std::pair<double, double>> all;
    for (const CrackedLife& life : cracked) {
        for (std::size_t r = life.first; r < life.values.size(); ++r) {
            if (!std::isnan(life.values[r])) {
                all.emplace_back(life.sizes[r], life.values[r]);
            }
        }
    }
    std::ranges::stable_sort(all, {}, &std::pair<double, double>::first);
    return all;
}

constexpr double kNeverSeen = std::numeric_limits<double>::infinity();

// Order statistic of rank ceil(n q); NaN if there are no values.
double sample_quantile(std::vector<double> values, double quantile) {
    if (values.empty()) {
        return kNan;
    }
    const auto n = static_cast<double>(values.size());
    const auto rank = std::max<long>(1, std::lround(std::ceil(n * quantile - 1e-9)));
    const auto nth = values.begin() + (rank - 1);
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
}

// The same lives beginning at the first record whose crack has the size of its effect, which none
// precedes.
std::vector<CrackedLife> with_effect(std::span<const CrackedLife> cracked, double effect_size) {
    std::vector<CrackedLife> lives(cracked.begin(), cracked.end());
    for (CrackedLife& life : lives) {
        while (life.first < life.sizes.size() && !(life.sizes[life.first] >= effect_size)) {
            ++life.first;
        }
    }
    return lives;
}

// Record of the first alarm after the crack's effect. Counts those between its initiation and its
// effect.
std::optional<std::size_t> detection(const Detector& detector, const CrackedLife& life,
                                     std::size_t initiation, double threshold, long& early) {
    for (const std::size_t record : detector_alarms(detector, life.values, threshold).alarms) {
        if (record >= life.first) {
            return record;
        }
        early += record >= initiation ? 1 : 0;
    }
    return std::nullopt;
}

// Share over all pairs of a healthy life and a cracked one that ends.
double share_by_chance(const Detector& detector, std::span<const HealthyLife> healthy,
                       std::span<const CrackedLife> cracked, double threshold) {
    long pairs = 0, found = 0;
    for (const HealthyLife& sound : healthy) {
        const std::vector<std::size_t> alarms =
            detector_alarms(detector, sound.values, threshold).alarms;
        for (const CrackedLife& life : cracked) {
            if (life.end_hours) {
                const auto first = std::lower_bound(alarms.begin(), alarms.end(), life.first);
                ++pairs;
                found += first != alarms.end() && *first < life.values.size() ? 1 : 0;
            }
        }
    }
    return pairs > 0 ? static_cast<double>(found) / static_cast<double>(pairs) : kNan;
}

// Values that do not exist come last.
double or_last(double value) {
    return std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
}

// Probability that chance finds as many cracks or more.
double chance_of(const MonitorPerformance& performance) {
    const double share = std::fmax(performance.share_by_chance, performance.share_at_stated_rate);
    return performance.found == 0
               ? 1.0
               : 1.0 - binomial_cdf(static_cast<double>(performance.ended), share,
                                    static_cast<double>(performance.found - 1));
}

}  // namespace

double effect_size(std::span<const HealthyLife> healthy, std::span<const CrackedLife> cracked,
                   bool two_sided) {
    constexpr std::size_t kMostGroups = 20, kLeastRecords = 40;
    std::vector<double> normal;
    for (const HealthyLife& life : healthy) {
        std::ranges::copy_if(life.values, std::back_inserter(normal),
                             [](double value) { return !std::isnan(value); });
    }
    if (normal.empty()) {
        return kNan;
    }
    const double deviation = 0.5 * (quantile_of(normal, 0.84) - quantile_of(normal, 0.16)),
                 median = quantile_of(normal, 0.5), high = quantile_of(normal, 0.9),
                 low = quantile_of(normal, 0.1);
    const auto records = sizes_and_values(cracked);
    const std::size_t groups =
        std::clamp<std::size_t>(records.size() / kLeastRecords, 1, kMostGroups);
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t g = groups; g-- > 0 && !records.empty();) {
        const std::size_t begin = g * records.size() / groups,
                          end = (g + 1) * records.size() / groups;
        std::vector<double> values;
        for (std::size_t i = begin; i < end; ++i) {
            values.push_back(records[i].second);
        }
        const double shift = quantile_of(values, 0.5) - median;
        double moved = std::max(shift, quantile_of(values, 0.9) - high);
        if (two_sided) {
            moved = std::max({moved, -shift, low - quantile_of(values, 0.1)});
        }
        if (!(moved > 0.0 && moved >= kEffectDeviations * deviation)) {
            break;
        }
        smallest = records[begin].first;
    }
    return smallest;
}

double quantile_bound(std::vector<double> values, double quantile, double confidence) {
    std::sort(values.begin(), values.end());
    // The r-th smallest value lies below the quantile if r or more values do.
    const auto count = static_cast<double>(values.size());
    for (std::size_t r = 1; r <= values.size(); ++r) {
        if (binomial_cdf(count, quantile, static_cast<double>(r - 1)) >= confidence) {
            return values[r - 1];
        }
    }
    return kNan;
}

MonitorPerformance monitor_performance(const Detector& detector,
                                       std::span<const HealthyLife> setting,
                                       std::span<const HealthyLife> healthy,
                                       std::span<const CrackedLife> cracked, double per_1000_h,
                                       double confidence) {
    MonitorPerformance performance;
    performance.threshold = monitor_threshold(detector, setting, per_1000_h);
    const double threshold = performance.threshold.value;
    performance.false_alarms = false_alarms(detector, healthy, threshold, confidence);
    performance.expected_per_1000_h =
        expected_per_1000_h(performance.threshold, performance.false_alarms);
    if (std::isnan(threshold)) {
        return performance;
    }
    performance.effect_size = effect_size(setting, cracked, detector.two_sided);
    const std::vector<CrackedLife> lives = with_effect(cracked, performance.effect_size);
    std::vector<double> sizes, warnings;
    double by_stated_rate = 0.0;
    for (std::size_t i = 0; i < lives.size(); ++i) {
        const CrackedLife& life = lives[i];
        const std::size_t initiation = cracked[i].first;
        const auto record =
            detection(detector, life, initiation, threshold, performance.early_alarms);
        if (initiation < life.hours.size()) {
            const double last_h = life.end_hours.value_or(life.hours.back());
            performance.early_hours +=
                (life.first < life.hours.size() ? life.hours[life.first] : last_h) -
                life.hours[initiation];
        }
        performance.alarm_hours.push_back(record ? life.hours[*record] : kNan);
        if (!life.end_hours) {
            continue;
        }
        ++performance.ended;
        if (life.first < life.hours.size()) {
            const double watched = *life.end_hours - life.hours[life.first];
            by_stated_rate -= std::expm1(-1e-3 * per_1000_h * watched);
        }
        sizes.push_back(record ? life.sizes[*record] : kNeverSeen);
        if (record) {
            ++performance.found;
            warnings.push_back(*life.end_hours - life.hours[*record]);
        }
    }
    if (performance.ended > 0) {
        performance.share =
            static_cast<double>(performance.found) / static_cast<double>(performance.ended);
        performance.share_at_stated_rate = by_stated_rate / static_cast<double>(performance.ended);
        performance.share_by_chance = share_by_chance(detector, healthy, lives, threshold);
        performance.share_bounds =
            wilson_interval(performance.found, performance.ended, confidence);
    }
    performance.size_50 = {sample_quantile(sizes, 0.5), quantile_bound(sizes, 0.5, confidence)};
    performance.size_90 = {sample_quantile(sizes, 0.9), quantile_bound(sizes, 0.9, confidence)};
    performance.warning_50 = sample_quantile(warnings, 0.5);
    performance.warning_90 = sample_quantile(warnings, 0.1);
    return performance;
}

double net_share(const MonitorPerformance& performance) {
    const double chance = std::isnan(performance.share_by_chance) ? performance.share_at_stated_rate
                                                                  : performance.share_by_chance;
    return performance.share - chance;
}

std::string why_unranked(const MonitorPerformance& performance, double per_1000_h) {
    if (std::isnan(performance.threshold.value)) {
        return "no threshold";
    }
    if (performance.ended == 0) {
        return "no tooth fails";
    }
    if (performance.false_alarms.bounds.lower > per_1000_h) {
        return "more false alarms than stated";
    }
    if (!(chance_of(performance) <= kChanceLevel)) {
        return "no significantly larger share found than by chance";
    }
    return "";
}

bool ranks_before(const MonitorPerformance& a, const MonitorPerformance& b) {
    const auto key = [](const MonitorPerformance& performance) {
        return std::tuple(or_last(-net_share(performance)), or_last(performance.size_90.value),
                          or_last(performance.size_50.value),
                          or_last(performance.false_alarms.per_1000_h));
    };
    return key(a) < key(b);
}

}  // namespace gearpod::analysis
