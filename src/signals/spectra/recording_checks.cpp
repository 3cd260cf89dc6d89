#include "signals/spectra/recording_checks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "machine/upper_median.hpp"
#include "signals/spectra/order_spectrum.hpp"

namespace gearpod::signals {

std::span<const double> fast_part(std::span<const double> samples) {
    constexpr std::size_t kMostSamples = std::size_t{1} << 20;
    for (std::size_t n = std::min(samples.size(), kMostSamples); n > 1; --n) {
        std::size_t rest = n;
        for (const std::size_t prime : {2U, 3U, 5U}) {
            while (rest % prime == 0) {
                rest /= prime;
            }
        }
        if (rest == 1 && n % 2 == 0) {
            return samples.first(n);
        }
    }
    return {};
}

std::vector<double> hann_amplitudes(std::span<const double> samples, int zeros) {
    const auto length = static_cast<int>(samples.size());
    const double mean = std::accumulate(samples.begin(), samples.end(), 0.0) / length;
    std::vector<double> windowed;
    for (int i = 0; i < length; ++i) {
        windowed.push_back((samples[static_cast<std::size_t>(i)] - mean) *
                           (0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * i / length)));
    }
    windowed.resize(samples.size() + static_cast<std::size_t>(zeros), 0.0);
    OrderSpectrum spectrum(length + zeros);
    spectrum.load(windowed);
    std::vector<double> amplitude(static_cast<std::size_t>(spectrum.orders()));
    spectrum.amplitudes(0.0, amplitude);
    return amplitude;
}

namespace {

constexpr int kFewestTurns = 6;
constexpr double kLeastTurnCorrelation = 0.3;  // correlation of similar turns

// Number of samples by which the signal occurs earlier in `next` than in `before`, and the
// correlation at that lag. Both turns have more samples around them, from which a lag takes its
// samples.
struct Lag {
    double samples = 0.0, correlation = 0.0;
};

Lag lag_between(std::span<const double> all, std::size_t before, std::size_t next,
                std::size_t length, int farthest) {
    const auto correlation = [&](int lag) {
        double xy = 0.0, xx = 0.0, yy = 0.0;
        for (std::size_t i = static_cast<std::size_t>(farthest); i + farthest < length; ++i) {
            const double x = all[before + i];
            const double y =
                all[next + i - static_cast<std::size_t>(lag)];  // wraps around and back
            xy += x * y;
            xx += x * x;
            yy += y * y;
        }
        return xx > 0.0 && yy > 0.0 ? xy / std::sqrt(xx * yy) : 0.0;
    };
    std::vector<double> values;
    for (int lag = -farthest; lag <= farthest; ++lag) {
        values.push_back(correlation(lag));
    }
    const auto best = std::max_element(values.begin(), values.end()) - values.begin();
    double part = 0.0;
    if (best > 0 && best + 1 < static_cast<std::ptrdiff_t>(values.size())) {
        const auto index = static_cast<std::size_t>(best);
        const double bend = values[index - 1] - 2.0 * values[index] + values[index + 1];
        part = bend < 0.0 ? 0.5 * (values[index - 1] - values[index + 1]) / bend : 0.0;
    }
    return {static_cast<double>(best) - farthest + part, values[static_cast<std::size_t>(best)]};
}

}  // namespace

std::optional<LostSamples> lost_samples(std::span<const double> samples, int per_mesh,
                                        int turn_meshes) {
    const std::size_t length =
        static_cast<std::size_t>(per_mesh) * static_cast<std::size_t>(turn_meshes);
    const std::size_t turns = length > 0 ? samples.size() / length : 0;
    const int farthest = per_mesh / 2;  // the correlation repeats with the mesh period
    if (turn_meshes < 2 || turns < kFewestTurns) {
        return std::nullopt;
    }
    std::vector<double> steps, correlations;
    for (std::size_t t = 1; t < turns; ++t) {
        const Lag lag = lag_between(samples, (t - 1) * length, t * length, length, farthest);
        steps.push_back(lag.samples);
        correlations.push_back(lag.correlation);
    }
    if (machine::upper_median(correlations) < kLeastTurnCorrelation) {
        return std::nullopt;
    }
    const double usual = machine::upper_median(steps);
    std::vector<double> deviations;
    for (const double step : steps) {
        deviations.push_back(std::abs(std::remainder(step - usual, static_cast<double>(per_mesh))));
    }
    constexpr double kLeast = 0.05, kStandsOut = 8.0;
    const double scatter = std::max(kLeast, 1.4826 * machine::upper_median(deviations));
    // The turn with the loss is shifted in part, so two successive steps share the loss.
    LostSamples most;
    double largest = 0.0;
    for (std::size_t t = 0; t + 1 < steps.size(); ++t) {
        const double sum =
            std::remainder(steps[t] + steps[t + 1] - 2.0 * usual, static_cast<double>(per_mesh));
        if (std::abs(sum) > std::abs(largest)) {
            largest = sum;
            most.first_mesh = static_cast<int>(t) * turn_meshes;
            most.last_mesh = static_cast<int>(t + 3) * turn_meshes;
        }
    }
    most.meshes = largest / per_mesh;
    most.found = std::abs(largest) > kStandsOut * scatter;
    return most;
}

}  // namespace gearpod::signals
