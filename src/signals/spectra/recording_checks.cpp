#include "signals/spectra/recording_checks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "machine/upper_median.hpp"
#include "signals/spectra/order_spectrum.hpp"

namespace gearpod::signals {
namespace {

constexpr double kMaxRatioDeviation = 0.06;  // largest deviation of the ratio from 1
constexpr int kMostHarmonics = 8;            // beyond, the search bands of neighbours overlap
constexpr double kMinPeakToMedian = 5.0;     // amplitude over the median of its band
constexpr double kLineSpread = 4.0;          // of the lines around a harmonic, in turn frequencies
constexpr double kMinFit = 0.3;          // smallest accepted fraction of the amplitudes on the comb
constexpr double kComparableFit = 0.85;  // fraction of the best fit

struct Line {
    double order;  // per mesh
    double amplitude;
    int harmonic;
};

std::vector<Line> strong_lines(const std::vector<double>& amplitude, double meshes) {
    std::vector<Line> lines;
    for (int k = 1; k <= kMostHarmonics; ++k) {
        const auto first =
            static_cast<std::size_t>(std::ceil(k * (1.0 - kMaxRatioDeviation) * meshes));
        const auto last =
            static_cast<std::size_t>(std::floor(k * (1.0 + kMaxRatioDeviation) * meshes));
        if (last + 1 >= amplitude.size()) {
            break;
        }
        std::vector<double> band(amplitude.begin() + static_cast<std::ptrdiff_t>(first),
                                 amplitude.begin() + static_cast<std::ptrdiff_t>(last) + 1);
        const auto middle = band.begin() + static_cast<std::ptrdiff_t>(band.size() / 2);
        std::nth_element(band.begin(), middle, band.end());
        double most = 0.0;
        for (std::size_t bin = first; bin <= last; ++bin) {
            most = std::max(most, amplitude[bin]);
        }
        // Threshold above the noise and above the skirts of stronger lines.
        const double least = std::max(kMinPeakToMedian * *middle, 0.05 * most);
        for (std::size_t bin = first; bin <= last; ++bin) {
            if (amplitude[bin] > least && amplitude[bin] >= amplitude[bin - 1] &&
                amplitude[bin] >= amplitude[bin + 1]) {
                // Amplitudes are normalised so that every harmonic counts equally, whatever its
                // strength.
                lines.push_back({static_cast<double>(bin) / meshes, amplitude[bin] / most, k});
            }
        }
    }
    return lines;
}

// Fraction of the amplitudes that the comb stretched by `ratio` covers.
double fit_of(const std::vector<Line>& lines, double ratio, int turn_meshes, double width) {
    double on = 0.0, all = 0.0;
    for (const Line& line : lines) {
        const double offset = (line.order / ratio - line.harmonic) * turn_meshes;
        const double from_tooth = std::abs(offset - std::round(offset)) / width;
        const double near = std::exp(-0.5 * std::pow(offset / kLineSpread, 2));
        on += line.amplitude * near * std::max(0.0, 1.0 - from_tooth);
        all += line.amplitude;
    }
    return on / all;
}

}  // namespace

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

std::vector<double> hann_amplitudes(std::span<const double> samples, double mean) {
    const auto length = static_cast<int>(samples.size());
    std::vector<double> windowed;
    for (int i = 0; i < length; ++i) {
        windowed.push_back((samples[static_cast<std::size_t>(i)] - mean) *
                           (0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * i / length)));
    }
    OrderSpectrum spectrum(length);
    spectrum.load(windowed);
    std::vector<double> amplitude(static_cast<std::size_t>(spectrum.orders()));
    spectrum.amplitudes(0.0, amplitude);
    return amplitude;
}

std::optional<MeshSpeed> mesh_speed(std::span<const double> samples, int per_mesh,
                                    int turn_meshes) {
    constexpr int kFewestTurns = 4, kFewestHarmonics = 3;
    samples = fast_part(samples);
    const double meshes = static_cast<double>(samples.size()) / per_mesh;
    const double turns = meshes / turn_meshes;
    if (turn_meshes < 2 || turns < kFewestTurns) {
        return std::nullopt;
    }
    const std::vector<Line> lines = strong_lines(hann_amplitudes(samples, 0.0), meshes);
    std::set<int> harmonics;
    for (const Line& line : lines) {
        harmonics.insert(line.harmonic);
    }
    if (harmonics.size() < kFewestHarmonics) {
        return std::nullopt;
    }
    // Each comb tooth is 1.5 bins wide, at most a third of the distance to the next one.
    const double width = std::min(0.33, 1.5 / turns);
    const double step = 0.25 / (meshes * *harmonics.rbegin());
    MeshSpeed best{1.0, 0.0, fit_of(lines, 1.0, turn_meshes, width)};
    best.fit = best.stated;
    best.harmonics = static_cast<int>(harmonics.size());
    const auto scan_ratios = [&](const auto& use) {
        for (double ratio = 1.0 - kMaxRatioDeviation; ratio <= 1.0 + kMaxRatioDeviation;
             ratio += step) {
            use(ratio, fit_of(lines, ratio, turn_meshes, width));
        }
    };
    scan_ratios([&](double ratio, double fit) {
        if (fit > best.fit) {
            best.ratio = ratio;
            best.fit = fit;
        }
    });
    double best_other_fit = kComparableFit * best.fit;
    scan_ratios([&](double ratio, double fit) {
        if (fit > best_other_fit && std::abs(ratio - best.ratio) * turn_meshes > 0.5) {
            best.other = ratio;
            best_other_fit = fit;
        }
    });
    return best.fit > kMinFit ? std::optional(best) : std::nullopt;
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
