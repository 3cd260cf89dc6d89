#include "analysis/detection/clusters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "analysis/detection/clustered_rate.hpp"
#include "analysis/statistics/every_nth.hpp"

namespace gearpod::analysis {
namespace {

// True if all values equal to the threshold belong to one gearbox. Noise-free records of one
// gearbox are equal, which does not make the feature a constant.
bool tied_within_one(std::span<const double> values, std::span<const std::size_t> gearbox,
                     double threshold) {
    std::set<std::size_t> tied;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (values[i] == threshold) {
            tied.insert(gearbox[i]);
        }
    }
    return tied.size() == 1;
}

}  // namespace

FeatureDetection detect_clustered(const std::string& feature, Alarm alarm,
                                  const FeatureSample& healthy,
                                  std::span<const std::size_t> gearbox, const FeatureSample& graded,
                                  const DetectionRequest& request) {
    FeatureDetection result = detect(feature, alarm, healthy, graded, request);
    const std::size_t count = std::set<std::size_t>(gearbox.begin(), gearbox.end()).size();
    if (count == gearbox.size() || !healthy.weights.empty()) {
        return result;
    }
    const std::size_t levels = request.noise_levels.size();
    for (std::size_t n = 0; n < levels; ++n) {
        LevelDetection& level = result.levels[n];
        if (std::isnan(level.threshold)) {
            continue;
        }
        const std::vector<double> values = every_nth(healthy.values, n, levels);
        if (tied_within_one(values, gearbox, level.threshold)) {
            const std::string tie = fmt::format(
                "noise level {:g}: healthy records equal the threshold", level.noise_level);
            std::erase_if(result.warnings,
                          [&](const std::string& warning) { return warning.starts_with(tie); });
        }
        const Interval own = level.threshold_rate;
        const Interval clustered =
            level.tail ? Interval{kNan, kNan}
                       : clustered_rate_interval(values, gearbox, alarm, level.threshold,
                                                 request.false_alarm_rate, request.confidence);
        // Never narrower than the interval of independent values.
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
                ? fmt::format("noise level {:g}: {} healthy records come from only {} gearboxes, "
                              "so the false-alarm rate of the extrapolated threshold is unknown",
                              level.noise_level, level.threshold_sample, count)
                : fmt::format(
                      "noise level {:g}: {} healthy records come from only {} gearboxes, so the "
                      "false-alarm rate of {:g} is known only to within [{:.2g}, {:.2g}]",
                      level.noise_level, level.threshold_sample, count, request.false_alarm_rate,
                      level.threshold_rate.lower, level.threshold_rate.upper));
    }
    // Removes the warnings that assume independent values.
    std::erase_if(result.warnings, [](const std::string& warning) {
        return warning.find("healthy records determine the false-alarm rate") != std::string::npos;
    });
    return result;
}

}  // namespace gearpod::analysis
