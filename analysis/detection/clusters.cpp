#include "analysis/detection/clusters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>

#include "analysis/detection/false_alarm_rate.hpp"
#include "analysis/detection/threshold.hpp"
#include "analysis/statistics/midranks.hpp"
#include "analysis/statistics/quiet_policy.hpp"

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

// Scatter of the alarms between gearboxes over that of as many independent recordings.
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

// As many gearboxes that all had as many alarms would tell as much of their scatter.
double alarming(const Gearboxes& gearboxes) {
    double alarms = 0.0, squares = 0.0;
    for (const auto& [number, gearbox] : gearboxes) {
        alarms += gearbox.alarms;
        squares += gearbox.alarms * gearbox.alarms;
    }
    return squares > 0.0 ? alarms * alarms / squares : 0.0;
}

double normal_beyond(double z) {
    return 0.5 * std::erfc(z / std::numbers::sqrt2);
}

double normal_quantile(double p) {
    return -std::numbers::sqrt2 * boost::math::erfc_inv(2.0 * p, QuietPolicy());
}

// The gearboxes' share of the variance of normal scores, by the analysis of variance of some
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
    std::size_t at = 0;
    for (const auto& [number, gearbox] : gearboxes) {
        const std::size_t own = std::min(kMost, gearbox.values.size());
        double sum = 0.0, sum2 = 0.0;
        for (std::size_t i = 0; i < own; ++i, ++at) {
            const double score = normal_quantile((ranks[at] - 0.5) / n);
            sum += score;
            sum2 += score * score;
        }
        const auto count = static_cast<double>(own);
        between += sum * sum / count;  // the scores' mean is 0
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

// Of two recordings of a gearbox, the probability that both lie beyond a threshold of that rate,
// were their scores normal: with a share of the variance in common.
double both_beyond(double rate, double share) {
    if (share <= 0.0) {
        return rate * rate;
    }
    constexpr double kReach = 9.0;
    constexpr int kSteps = 600;
    const double z = -normal_quantile(rate), own = std::sqrt(std::max(1e-9, 1.0 - share));
    double sum = 0.0;
    for (int i = 0; i <= kSteps; ++i) {
        const double m = kReach * (2.0 * i / kSteps - 1.0);
        const double one = normal_beyond((z - std::sqrt(share) * m) / own);
        sum += std::exp(-0.5 * m * m) * one * one;
    }
    return sum * 2.0 * kReach / kSteps / std::sqrt(2.0 * std::numbers::pi);
}

double beta_quantile(double a, double b, double p) {
    return boost::math::quantile(boost::math::beta_distribution<double, QuietPolicy>(a, b), p);
}

// By an effective sample size; `telling`: of how many gearboxes its scatter is known.
Interval effective_interval(double recordings, double effect, double telling, double rate,
                            double tail) {
    const boost::math::students_t few(telling - 1.0);
    const boost::math::normal many;
    const double narrower =
        boost::math::quantile(many, 1.0 - tail) / boost::math::quantile(few, 1.0 - tail);
    const double sample = recordings / effect * narrower * narrower + 1.0;
    const double a = sample * rate, b = sample - a;
    return {beta_quantile(a, b, tail), beta_quantile(a, b, 1.0 - tail)};
}

// Where alarms are rarer than gearboxes: the scatter between these is that of the normal scores, or
// what is seen of it. Empty where few gearboxes have the alarms, or they scatter more than normal
// ones.
std::optional<Interval> rare_interval(const Gearboxes& gearboxes, double rate, double tail) {
    constexpr double kTelling = 20.0, kLeastAlarming = 15.0, kAlike = 1.3;
    const Totals all = totals(gearboxes);
    const double others = all.recordings / all.gearboxes - 1.0;
    const double both = both_beyond(rate, share_of_gearboxes(gearboxes));
    const double effect = 1.0 + others * (both - rate * rate) / (rate * (1.0 - rate));
    const double telling = all.recordings * rate / (1.0 + others * both / rate);
    const double seen = design_effect(gearboxes), alarming_now = alarming(gearboxes);
    if (telling < kTelling || alarming_now < kLeastAlarming || seen > kAlike * effect) {
        return std::nullopt;
    }
    return effective_interval(all.recordings, std::max(seen, effect),
                              std::min(telling, alarming_now), rate, tail);
}

}  // namespace

Interval clustered_rate_interval(std::span<const double> values,
                                 std::span<const std::size_t> gearbox, Alarm alarm,
                                 double threshold, double false_alarm_rate, double confidence) {
    Gearboxes gearboxes;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (std::isfinite(values[i])) {
            Gearbox& own = gearboxes[gearbox[i]];
            own.values.push_back(values[i]);
            own.alarms += is_alarm(values[i], threshold, alarm) ? 1.0 : 0.0;
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
    // As if all recordings of a gearbox were one: the order statistic is then one of gearboxes,
    // from which fewer may lie beyond than the rate asks for, or more.
    const double rank = std::ceil(
        static_cast<double>(threshold_rank(std::lround(all.recordings), false_alarm_rate)) /
        all.recordings * all.gearboxes);
    const double a = (all.gearboxes + 1.0) * false_alarm_rate;
    return {beta_quantile(a, all.gearboxes + 1.0 - a, tail),
            beta_quantile(std::max(1.0, all.gearboxes + 1.0 - rank), std::min(rank, all.gearboxes),
                          1.0 - tail)};
}

FeatureDetection detect_clustered(const std::string& feature, Alarm alarm,
                                  const FeatureSample& healthy,
                                  std::span<const std::size_t> gearbox, const FeatureSample& graded,
                                  const DetectionRequest& request) {
    FeatureDetection result = detect(feature, alarm, healthy, graded, request);
    const std::size_t count = std::set<std::size_t>(gearbox.begin(), gearbox.end()).size();
    if (count == gearbox.size()) {
        return result;
    }
    const std::size_t levels = request.noise_levels.size();
    for (std::size_t n = 0; n < levels; ++n) {
        LevelDetection& level = result.levels[n];
        if (std::isnan(level.threshold)) {
            continue;
        }
        std::vector<double> values;
        for (std::size_t i = 0; i < gearbox.size(); ++i) {
            values.push_back(healthy.values[i * levels + n]);
        }
        const Interval own = level.threshold_rate;
        const Interval clustered =
            level.tail ? Interval{kNan, kNan}
                       : clustered_rate_interval(values, gearbox, alarm, level.threshold,
                                                 request.false_alarm_rate, request.confidence);
        // Never narrower than of independent ones.
        level.threshold_rate = {std::min(own.lower, clustered.lower),
                                std::max(own.upper, clustered.upper)};
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
                ? fmt::format("noise level {:g}: {} healthy ones are of {} gearboxes, what lies "
                              "beyond them is not known: the false-alarm rate of the extrapolated "
                              "threshold may be anything",
                              level.noise_level, level.threshold_sample, count)
                : fmt::format("noise level {:g}: {} healthy ones are of {} gearboxes, which fix "
                              "the false-alarm rate of {:g} to within [{:.2g}, {:.2g}]",
                              level.noise_level, level.threshold_sample, count,
                              request.false_alarm_rate, level.threshold_rate.lower,
                              level.threshold_rate.upper));
    }
    // What independent ones would have fixed.
    std::erase_if(result.warnings, [](const std::string& warning) {
        return warning.find("healthy ones fix the false-alarm rate") != std::string::npos;
    });
    return result;
}

}  // namespace gearpod::analysis
