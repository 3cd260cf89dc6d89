#include "mc/gearbox/sample_times.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "machine/upper_median.hpp"
#include "signals/spectra/lost_samples.hpp"

namespace gearpod::mc {
namespace {

constexpr double kEven = 1e-3;  // relative to a step

// Largest power of ten, from 1 down to 1e-9, of which all values are multiples; 0 if there is none.
double decimals_of(const std::vector<double>& values) {
    for (int digits = 0; digits <= 9; ++digits) {
        const double unit = std::pow(10.0, -digits);
        const bool all = std::all_of(values.begin(), values.end(), [&](double value) {
            const double multiple = value / unit;
            return std::abs(multiple - std::round(multiple)) < 1e-4;
        });
        if (all) {
            return unit;
        }
    }
    return 0.0;
}

// Largest deviation from even spacing.
double unevenness(const std::vector<double>& time, double start, double step) {
    double most = 0.0;
    for (std::size_t i = 0; i < time.size(); ++i) {
        most = std::max(most, std::abs(time[i] - start - static_cast<double>(i) * step));
    }
    return most;
}

std::string spacing_problem(const std::vector<double>& time, double unit, double average) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < time.size(); ++i) {
        steps.push_back(time[i] - time[i - 1]);
    }
    const auto back =
        std::find_if(steps.begin(), steps.end(), [&](double step) { return step < -1.01 * unit; });
    if (back != steps.end()) {
        return fmt::format(
            "decreases by {:.6g} s from sample {} to the next; the samples must be evenly spaced",
            -*back, back - steps.begin() + 1);
    }
    const double usual = machine::upper_median(steps);
    const double allowed = std::max(0.5 * std::abs(usual), 1.01 * unit);
    for (std::size_t i = 0; i < steps.size(); ++i) {
        if (std::abs(steps[i] - usual) <= allowed) {
            continue;
        }
        const double samples = usual > 0.0 ? std::round(steps[i] / usual) - 1.0 : 0.0;
        return samples >= 1.0
                   ? fmt::format(
                         "there are {:.6g} s between sample {} and the next, and {:.6g} s between "
                         "most samples: {:.0f} sample(s) are missing; use only the part before or "
                         "after",
                         steps[i], i + 1, usual, samples)
                   : fmt::format(
                         "there are {:.6g} s between sample {} and the next, and {:.6g} s between "
                         "most samples; the samples must be evenly spaced",
                         steps[i], i + 1, usual);
    }
    const auto worst = std::max_element(steps.begin(), steps.end(), [&](double a, double b) {
        return std::abs(a - average) < std::abs(b - average);
    });
    return fmt::format(
        "{:.6g} s from sample {} to the next, but {:.6g} s on average; the samples "
        "must be evenly spaced",
        *worst, worst - steps.begin() + 1, average);
}

}  // namespace

SampleTimes sample_times(std::vector<double> column) {
    const auto last = static_cast<double>(column.size() - 1);
    double average = (column.back() - column.front()) / last;
    bool even = average > 0.0;
    for (std::size_t i = 1; i < column.size() && even; ++i) {
        even = std::abs(column[i] - column[i - 1] - average) <= kEven * average;
    }
    if (even) {
        return {std::move(column), ""};
    }
    // Rounded times deviate from evenly spaced ones by up to half a unit; a fitted line is more
    // accurate.
    const double unit = decimals_of(column);
    double mean = 0.0, slope = 0.0, squares = 0.0;
    for (const double value : column) {
        mean += value / (last + 1.0);
    }
    for (std::size_t i = 0; i < column.size(); ++i) {
        const double from_middle = static_cast<double>(i) - 0.5 * last;
        slope += from_middle * (column[i] - mean);
        squares += from_middle * from_middle;
    }
    const double step = slope / squares, start = mean - 0.5 * last * step;
    if (!(step > 0.0 && unevenness(column, start, step) <= std::max(kEven * step, 1.01 * unit))) {
        return {{}, spacing_problem(column, unit, average)};
    }
    for (std::size_t i = 0; i < column.size(); ++i) {
        column[i] = start + static_cast<double>(i) * step;
    }
    return {std::move(column), ""};
}

Pulses tachometer_pulses(std::span<const double> column) {
    constexpr std::size_t kFewest = 3;
    constexpr double kHysteresis = 0.2;  // relative to the height, on both sides of half the height
    constexpr double kIrregular = 1.5;
    const auto [low, high] = std::minmax_element(column.begin(), column.end());
    const double height = *high - *low, half = 0.5 * (*high + *low);
    Pulses pulses;
    bool armed = false;
    double crossing = 0.0;
    for (std::size_t i = 0; i < column.size(); ++i) {
        if (i > 0 && column[i - 1] < half && column[i] >= half) {
            crossing = static_cast<double>(i) - (column[i] - half) / (column[i] - column[i - 1]);
        }
        if (column[i] < half - kHysteresis * height) {
            armed = true;
        } else if (armed && column[i] > half + kHysteresis * height) {
            armed = false;
            pulses.at.push_back(crossing);
        }
    }
    if (pulses.at.size() < kFewest) {
        pulses.problem = fmt::format("{} pulse(s), but {} are needed", pulses.at.size(), kFewest);
        return pulses;
    }
    for (std::size_t i = 2; i < pulses.at.size(); ++i) {
        const double here = pulses.at[i] - pulses.at[i - 1];
        const double before = pulses.at[i - 1] - pulses.at[i - 2];
        if (here > kIrregular * before || before > kIrregular * here) {
            pulses.problem = fmt::format(
                "the pulses at samples {:.0f}, {:.0f} and {:.0f} are unevenly spaced: one is "
                "missing or superfluous",
                pulses.at[i - 2] + 1.0, pulses.at[i - 1] + 1.0, pulses.at[i] + 1.0);
            return pulses;
        }
    }
    return pulses;
}

PulseCount count_pulses(const std::vector<double>& pulses) {
    const std::size_t n = pulses.size();
    // Pulses per sample at each pulse, from its neighbours.
    std::vector<double> speed(n);
    for (std::size_t p = 0; p < n; ++p) {
        const std::size_t before = p == 0 ? 0 : p - 1, after = std::min(p + 1, n - 1);
        speed[p] = static_cast<double>(after - before) / (pulses[after] - pulses[before]);
    }
    PulseCount out;
    out.first = static_cast<std::size_t>(std::ceil(pulses.front()));
    std::size_t p = 0;
    for (auto at = static_cast<double>(out.first); at <= pulses.back(); at += 1.0) {
        while (p + 2 < n && at > pulses[p + 1]) {
            ++p;
        }
        const double length = pulses[p + 1] - pulses[p], t = (at - pulses[p]) / length;
        // Cubic Hermite interpolation between p and p + 1.
        out.count.push_back(static_cast<double>(p) + t * t * (3.0 - 2.0 * t) +
                            length * t * (1.0 - t) * (speed[p] * (1.0 - t) - speed[p + 1] * t));
    }
    return out;
}

namespace {

// Removes the jumps of 2 pi, and makes the angle rise.
void unwrap(std::vector<double>& angle) {
    constexpr double kTurn = 2.0 * std::numbers::pi;
    double turns = 0.0, before = angle.front();
    for (double& value : angle) {
        turns -= std::round((value - before) / kTurn);
        before = value;
        value += turns * kTurn;
    }
    if (angle.back() < angle.front()) {
        for (double& value : angle) {
            value = -value;
        }
    }
}

}  // namespace

ShaftAngle shaft_angle(std::vector<double> column) {
    unwrap(column);
    ShaftAngle angle;
    const auto fall = std::adjacent_find(column.begin(), column.end(), std::greater<>());
    const auto samples = [](auto from, auto to) { return static_cast<std::size_t>(to - from); };
    if (fall != column.end()) {
        angle.problem = fmt::format(
            "turns back by {:.3g} rad from sample {} to the next; cut the "
            "recording there",
            *fall - *(fall + 1), samples(column.begin(), fall) + 1);
        return angle;
    }
    if (std::adjacent_find(column.begin(), column.end()) == column.end()) {
        angle.rad = std::move(column);
        return angle;
    }
    // The count changes between two samples: the shaft angle half a sample before the new count is
    // the mean of both counts.
    std::vector<double> at, half_way;
    for (std::size_t i = 1; i < column.size(); ++i) {
        if (column[i] > column[i - 1]) {
            at.push_back(static_cast<double>(i) - 0.5);
            half_way.push_back(0.5 * (column[i] + column[i - 1]));
        }
    }
    if (at.size() < 3) {
        angle.problem = fmt::format("changes at only {} sample(s)", at.size());
        return angle;
    }
    angle.first = static_cast<std::size_t>(std::ceil(at.front()));
    std::size_t k = 0;
    for (auto i = static_cast<double>(angle.first); i <= at.back(); i += 1.0) {
        while (i > at[k + 1]) {
            ++k;
        }
        angle.rad.push_back(
            std::lerp(half_way[k], half_way[k + 1], (i - at[k]) / (at[k + 1] - at[k])));
    }
    return angle;
}

std::vector<double> evenly_spaced(std::size_t samples, double rate) {
    std::vector<double> values(samples);
    for (std::size_t i = 0; i < samples; ++i) {
        values[i] = static_cast<double>(i) / rate;
    }
    return values;
}

std::string sign_change_text(std::span<const double> speed) {
    const auto other =
        std::ranges::find_if(speed, [&](double value) { return value * speed.front() < 0.0; });
    return other == speed.end()
               ? ""
               : fmt::format("changes its sign at sample {}; cut the recording there",
                             other - speed.begin() + 1);
}

std::vector<double> integral(std::span<const double> time, std::span<const double> rate) {
    std::vector<double> sum(time.size(), 0.0);
    for (std::size_t i = 1; i < time.size(); ++i) {
        sum[i] = sum[i - 1] + 0.5 * (time[i] - time[i - 1]) * (rate[i - 1] + rate[i]);
    }
    return sum;
}

void extend_periodically(const std::vector<std::vector<double>*>& signals,
                         std::vector<double>& phase, double samples_per_turn) {
    constexpr std::size_t kMore = 8;
    const double turns = static_cast<double>(phase.size()) / samples_per_turn;
    if (std::abs(turns - std::round(turns)) > 1e-9 || phase.size() < kMore) {
        return;
    }
    const double step = phase[1] - phase[0];
    for (std::size_t i = 0; i < kMore; ++i) {
        phase.push_back(step * static_cast<double>(phase.size()));
        for (std::vector<double>* signal : signals) {
            if (!signal->empty()) {
                signal->push_back((*signal)[i]);
            }
        }
    }
}

std::string bad_values(std::span<const double> values) {
    constexpr double kLargest = 1e18;
    const auto is_bad = [](double value) { return !std::isfinite(value); };
    const auto bad = std::find_if(values.begin(), values.end(), is_bad);
    if (bad != values.end()) {
        return fmt::format(
            "{} of {} samples are not finite, the first is sample {}; cut them off or fill the "
            "gaps",
            std::count_if(values.begin(), values.end(), is_bad), values.size(),
            bad - values.begin() + 1);
    }
    const auto huge = std::find_if(values.begin(), values.end(),
                                   [](double value) { return std::abs(value) > kLargest; });
    return huge == values.end()
               ? ""
               : fmt::format("sample {} is {:g}; numbers above {:g} are not supported",
                             huge - values.begin() + 1, *huge, kLargest);
}

std::string clipping(std::span<const double> samples) {
    constexpr std::size_t kRun = 3;
    constexpr long kFewestRuns = 2;
    constexpr double kJump = 4.0;  // times the smallest difference between samples
    const auto [low, high] = std::minmax_element(samples.begin(), samples.end());
    double resolution = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < samples.size(); ++i) {
        const double difference = std::abs(samples[i] - samples[i - 1]);
        resolution = difference > 0.0 ? std::min(resolution, difference) : resolution;
    }
    long runs = 0, clipped = 0;
    double level = 0.0;
    for (std::size_t i = 0; i < samples.size();) {
        std::size_t end = i + 1;  // starts at i + 1 because a NaN does not equal itself
        while (end < samples.size() && samples[end] == samples[i]) {
            ++end;
        }
        const bool extreme = samples[i] == *high || samples[i] == *low;
        const bool steep = i > 0 && end < samples.size() &&
                           std::abs(samples[i] - samples[i - 1]) > kJump * resolution &&
                           std::abs(samples[i] - samples[end]) > kJump * resolution;
        if (extreme && steep && end - i >= kRun && *high > *low) {
            ++runs;
            clipped += static_cast<long>(end - i);
            level = samples[i];
        }
        i = end;
    }
    return runs >= kFewestRuns ? fmt::format(
                                     "clipped: {} samples in {} runs have the extreme value "
                                     "{:.6g}; record with a larger range",
                                     clipped, runs, level)
                               : "";
}

std::string losses_text(std::span<const double> samples, int per_mesh, int turn_meshes,
                        bool& detectable) {
    const auto lost = signals::lost_samples(samples, per_mesh, turn_meshes);
    detectable = lost.has_value();
    if (!lost || !lost->found) {
        return "";
    }
    return fmt::format(
        "the meshes are {:.2f} periods too {} (plus any number of whole periods) after mesh period "
        "{} to {}: samples were lost or repeated, which the times do not show; cut the recording "
        "there",
        std::abs(lost->meshes), lost->meshes > 0.0 ? "early" : "late", lost->first_mesh,
        lost->last_mesh);
}

}  // namespace gearpod::mc
