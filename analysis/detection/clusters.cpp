#include "analysis/detection/clusters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <map>
#include <set>

#include "analysis/detection/false_alarm_rate.hpp"
#include "analysis/detection/threshold.hpp"
#include "analysis/statistics/quiet_policy.hpp"

namespace gearpod::analysis {
namespace {

struct Gearbox {
    double recordings = 0.0, alarms = 0.0;
};

// Scatter of the alarms between gearboxes over that of as many independent recordings.
double design_effect(const std::map<std::size_t, Gearbox>& gearboxes) {
    double recordings = 0.0, alarms = 0.0, squares = 0.0;
    for (const auto& [number, gearbox] : gearboxes) {
        recordings += gearbox.recordings;
        alarms += gearbox.alarms;
    }
    const double rate = std::max(0.5, alarms) / recordings;
    for (const auto& [number, gearbox] : gearboxes) {
        const double excess = gearbox.alarms - rate * gearbox.recordings;
        squares += excess * excess;
    }
    const auto count = static_cast<double>(gearboxes.size());
    const double effect = count / (count - 1.0) * squares / (recordings * rate * (1.0 - rate));
    return std::clamp(effect, 1.0, recordings / count);
}

double beta_quantile(double a, double b, double p) {
    return boost::math::quantile(boost::math::beta_distribution<double, QuietPolicy>(a, b), p);
}

}  // namespace

Interval clustered_rate_interval(std::span<const double> values,
                                 std::span<const std::size_t> gearbox, Alarm alarm,
                                 double threshold, double false_alarm_rate, double confidence) {
    std::map<std::size_t, Gearbox> gearboxes;
    long recordings = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (std::isfinite(values[i])) {
            ++recordings;
            gearboxes[gearbox[i]].recordings += 1.0;
            gearboxes[gearbox[i]].alarms += is_alarm(values[i], threshold, alarm) ? 1.0 : 0.0;
        }
    }
    const auto count = static_cast<double>(gearboxes.size());
    const double tail = 0.5 * (1.0 - confidence);
    constexpr double kExpected = 5.0;
    if (count * false_alarm_rate >= kExpected) {
        const boost::math::students_t few(count - 1.0);
        const boost::math::normal many;
        const double narrower =
            boost::math::quantile(many, 1.0 - tail) / boost::math::quantile(few, 1.0 - tail);
        const double sample =
            static_cast<double>(recordings) / design_effect(gearboxes) * narrower * narrower + 1.0;
        const double a = sample * false_alarm_rate, b = sample - a;
        return {beta_quantile(a, b, tail), beta_quantile(a, b, 1.0 - tail)};
    }
    // As if all recordings of a gearbox were one: the order statistic is then one of gearboxes,
    // from which fewer may lie beyond than the rate asks for, or more.
    const double rank =
        std::ceil(static_cast<double>(threshold_rank(recordings, false_alarm_rate)) /
                  static_cast<double>(recordings) * count);
    const double a = (count + 1.0) * false_alarm_rate;
    return {beta_quantile(a, count + 1.0 - a, tail),
            beta_quantile(std::max(1.0, count + 1.0 - rank), std::min(rank, count), 1.0 - tail)};
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
        if (!tested) {
            level.healthy_rate_bounds = level.threshold_rate;
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
