#include "mc/recordings/quantisation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "features/modulation_indicators.hpp"
#include "features/statistics/signal_statistics.hpp"
#include "mc/recordings/sample_faults.hpp"
#include "mc/study/member.hpp"

namespace gearpod::mc {
namespace {

constexpr double kClearFactor = 4.0;  // RMS of a part over that of its rounding error
constexpr double kNumerical = 1e-12;  // of the signal's RMS
constexpr std::size_t kStepSamples = 65536;

double rms_about_mean(std::span<const double> values) {
    std::vector<double> about(values.begin(), values.end());
    subtract_mean(about);
    return rms_of(about);
}

// RMS of the rounding error in the regular signal: its orders have two of the N degrees of freedom
// each. The orders are the multiples of the mesh order below N / 2 and their two neighbours.
double rounding_of_regular(const features::SensorTurn& turn, double rounding) {
    const auto n = static_cast<double>(turn.turn.size());
    const double orders = 3.0 * std::floor(0.5 * n / turn.mesh_order);
    return rounding * std::sqrt(2.0 * orders / n);
}

std::string comparison(const char* what, double value, double rounding, const char* unit) {
    return fmt::format(
        "{} {:.2g} {} is at the level of the recording's rounding, which alone gives {:.2g} {}",
        what, value, unit, rounding, unit);
}

template <Member kGear>
std::string of_teeth(const features::FeatureInput& input, double rounding) {
    const std::span<const double> rms = input.get<features::ToothRms<kGear>>().rms;
    const double middle = features::median({rms.begin(), rms.end()});
    return middle < kClearFactor * rounding
               ? comparison("the median tooth rms", middle, rounding, "m/s^2")
               : "";
}

// True if the feature has no meaning without mesh lines.
bool divides_by_mesh_lines(const features::Feature& feature) {
    constexpr std::array kNames{"energy_ratio", "fm0"};
    return std::ranges::any_of(kNames,
                               [&](const char* name) { return feature.name.ends_with(name); });
}

// Reason for features of the averaged turn.
std::string of_turn(const features::Feature& feature, const features::SensorTurn& turn,
                    double rounding) {
    constexpr const char* kUnit = "m/s^2";
    if (feature.name.ends_with("sideband_index") || feature.name.ends_with("sideband_level")) {
        const double amplitude = 0.5 * features::both_sidebands(turn);
        const double error = 2.0 * rounding / std::sqrt(static_cast<double>(turn.turn.size()));
        return amplitude < kClearFactor * error
                   ? comparison("the sideband amplitude", amplitude, error, kUnit)
                   : "";
    }
    if (divides_by_mesh_lines(feature)) {
        const double regular = rms_of(turn.regular), error = rounding_of_regular(turn, rounding);
        return regular < kClearFactor * error
                   ? comparison("the rms of the mesh lines", regular, error, kUnit)
                   : "";
    }
    const bool whole = feature.name.ends_with("crest_factor") ||
                       feature.name == "change_kurtosis" || feature.name == "baseline_correlation";
    const double rms = whole ? rms_about_mean(turn.turn) : rms_of(turn.difference);
    return rms < kClearFactor * rounding
               ? comparison(whole ? "the rms of the average" : "the rms of the difference signal",
                            rms, rounding, kUnit)
               : "";
}

}  // namespace

double quantisation_step(std::span<const double> samples) {
    const auto used = samples.first(std::min(samples.size(), kStepSamples));
    std::vector<double> values(used.begin(), used.end());
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
    constexpr std::size_t kFewest = 3;  // values, of which two always have a step
    if (values.size() < kFewest) {
        return 0.0;
    }
    const double largest = std::max(std::abs(values.front()), std::abs(values.back()));
    const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * largest;
    double step = values.back() - values.front();
    for (std::size_t i = 1; i < values.size(); ++i) {
        if (const double apart = values[i] - values[i - 1]; apart > rounding) {
            step = std::min(step, apart);
        }
    }
    constexpr double kOff = 0.01;  // of a step
    const bool all = std::ranges::all_of(values, [&](double value) {
        const double steps = (value - values.front()) / step;
        return std::abs(steps - std::round(steps)) < kOff;
    });
    return all ? step : 0.0;
}

double rounding_rms(std::span<const double> samples) {
    return samples.empty() ? 0.0
                           : std::max(quantisation_step(samples) / std::sqrt(12.0),
                                      kNumerical * rms_of(samples));
}

std::string rounding_reason(const features::Feature& feature, const features::FeatureInput& input,
                            double rounding) {
    if (!feature.from_sensor) {
        return "";
    }
    if (feature.needs.has<features::SensorTurn>()) {
        return of_turn(feature, input.get<features::SensorTurn>(), rounding);
    }
    if (feature.needs.has<features::ToothRms<Member::planet>, features::WhitenedToothRms>()) {
        return of_teeth<Member::planet>(input, rounding);
    }
    if (feature.needs.has<features::ToothRms<Member::sun>>()) {
        return of_teeth<Member::sun>(input, rounding);
    }
    return "";  // ring teeth are divided by their trend, and have no unit
}

}  // namespace gearpod::mc
