#include "mc/report/signal_json.hpp"

#include <algorithm>
#include <boost/math/interpolators/cardinal_cubic_b_spline.hpp>
#include <cmath>
#include <complex>
#include <numbers>

#include "mc/report/thinning.hpp"
#include "signals/spectra/fourier_transform.hpp"
#include "signals/spectra/order_spectrum.hpp"

namespace gearpod::mc {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMostPlottedSamples = 2000;  // plotted samples of a time signal
constexpr std::size_t kMostLines = 500;            // plotted lines of a spectrum
constexpr double kZoomMeshes = 2.5;  // mesh frequencies to either side of the largest line

Json numbers_json(std::span<const double> values, std::span<const std::size_t> indices) {
    Json json = Json::array();
    for (const std::size_t i : indices) {
        json.push_back(values[i]);
    }
    return json;
}

// Spectral lines first to last - 1, `resolution_Hz` apart, thinned to the largest of each interval.
Json lines_json(std::span<const double> amplitude, std::size_t first, std::size_t last,
                double resolution_Hz) {
    const auto lines = amplitude.subspan(first, last - first);
    const auto kept = maxima(lines, kMostLines);
    Json json{{"frequency_Hz", Json::array()}, {"amplitude", numbers_json(lines, kept)}};
    for (const std::size_t i : kept) {
        json["frequency_Hz"].push_back(static_cast<double>(first + i) * resolution_Hz);
    }
    return json;
}

// One-sided amplitude spectrum over the whole span.
std::vector<double> amplitudes_of(const std::vector<double>& signal) {
    signals::OrderSpectrum spectrum(static_cast<int>(signal.size()));
    spectrum.load(signal);
    std::vector<double> amplitude(static_cast<std::size_t>(spectrum.orders()));
    spectrum.amplitudes(0.0, amplitude);
    return amplitude;
}

// The signal at `count` evenly spaced times from the first to the last. The places between the
// samples follow linearly from the times, the values from a cubic spline.
std::vector<double> evenly_spaced(std::span<const double> time_s, const std::vector<double>& signal,
                                  std::size_t count) {
    const boost::math::interpolators::cardinal_cubic_b_spline<double> spline(
        signal.begin(), signal.end(), 0.0, 1.0);
    const double first = time_s.front(),
                 step = (time_s.back() - first) / static_cast<double>(count - 1);
    std::vector<double> even;
    std::size_t after = 1;
    for (std::size_t i = 0; i < count; ++i) {
        const double at = first + step * static_cast<double>(i);
        while (after + 1 < time_s.size() && time_s[after] < at) {
            ++after;
        }
        const double inside = (at - time_s[after - 1]) / (time_s[after] - time_s[after - 1]);
        even.push_back(spline(static_cast<double>(after - 1) + std::clamp(inside, 0.0, 1.0)));
    }
    return even;
}

}  // namespace

nlohmann::json spectrogram_json(std::span<const double> time_s, const std::vector<double>& signal,
                                int samples_per_mesh, double highest_Hz) {
    constexpr std::size_t kMostBins = 120;
    constexpr double kLowest_dB = -60.0;
    const std::size_t mesh = static_cast<std::size_t>(samples_per_mesh),
                      length = kSpectrogramWindow * mesh;
    Json json{{"time_s", Json::array()},
              {"mesh_Hz", Json::array()},
              {"frequency_Hz", Json::array()},
              {"level_dB", Json::array()}};
    if (signal.size() < length) {
        return json;
    }
    const std::vector<double> even = evenly_spaced(time_s, signal, signal.size());
    const double duration = time_s.back() - time_s.front(),
                 step_s = duration / (static_cast<double>(signal.size()) - 1.0),
                 line_Hz = 1.0 / (step_s * static_cast<double>(length));
    const auto lines = std::min(length / 2, static_cast<std::size_t>(highest_Hz / line_Hz));
    const std::size_t each = std::max<std::size_t>(1, (lines + kMostBins - 1) / kMostBins);
    signals::FourierTransform transform(static_cast<int>(length));
    std::vector<std::complex<double>> windowed(length), spectrum(length);
    std::vector<std::vector<double>> amplitudes;
    double largest = 0.0;
    for (std::size_t first = 0; first + length <= even.size(); first += mesh) {
        for (std::size_t i = 0; i < length; ++i) {
            const double turn = (static_cast<double>(i) + 0.5) / static_cast<double>(length);
            windowed[i] = even[first + i] * (0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * turn));
        }
        transform.transform(windowed, spectrum);
        std::vector<double>& bins = amplitudes.emplace_back();
        for (std::size_t line = 1; line + each <= lines + 1; line += each) {
            double peak = 0.0;
            for (std::size_t k = line; k < line + each; ++k) {
                peak = std::max(peak, std::abs(spectrum[k]));
            }
            bins.push_back(peak);
            largest = std::max(largest, peak);
        }
        const double middle_s = time_s.front() + step_s * (static_cast<double>(first) +
                                                           0.5 * static_cast<double>(length));
        json["time_s"].push_back(middle_s);
        // Mesh period around the middle: the time of as many samples.
        const auto at =
            static_cast<std::size_t>(std::ranges::lower_bound(time_s, middle_s) - time_s.begin());
        const std::size_t from = std::clamp(at, mesh / 2, time_s.size() - 1 - mesh / 2) - mesh / 2;
        json["mesh_Hz"].push_back(static_cast<double>(2 * (mesh / 2)) / static_cast<double>(mesh) /
                                  (time_s[from + 2 * (mesh / 2)] - time_s[from]));
    }
    for (std::size_t bin = 0; bin < amplitudes.front().size(); ++bin) {
        json["frequency_Hz"].push_back(line_Hz * (1.0 + static_cast<double>(each * bin) +
                                                  0.5 * (static_cast<double>(each) - 1.0)));
    }
    for (const std::vector<double>& bins : amplitudes) {
        Json levels = Json::array();
        for (const double amplitude : bins) {
            const double level = largest > 0.0 && amplitude > 0.0
                                     ? 20.0 * std::log10(amplitude / largest)
                                     : kLowest_dB;
            levels.push_back(0.1 * std::round(10.0 * std::max(kLowest_dB, level)));
        }
        json["level_dB"].push_back(std::move(levels));
    }
    return json;
}

nlohmann::json time_json(std::span<const double> values, int samples_per_mesh) {
    const auto kept = extremes(values, kMostPlottedSamples);
    Json json{{"mesh", Json::array()}, {"value", numbers_json(values, kept)}};
    for (const std::size_t i : kept) {
        json["mesh"].push_back(static_cast<double>(i) / samples_per_mesh);
    }
    return json;
}

nlohmann::json spectrum_json(const std::vector<double>& clean, const std::vector<double>& noisy,
                             std::size_t meshes, double period_s) {
    const double resolution_Hz = 1.0 / (static_cast<double>(meshes) * period_s);
    const std::vector<double> without = amplitudes_of(clean), with = amplitudes_of(noisy);
    const auto top = static_cast<std::size_t>(std::max_element(without.begin() + 1, without.end()) -
                                              without.begin());
    const auto reach = static_cast<std::size_t>(kZoomMeshes * static_cast<double>(meshes));
    const std::size_t first = top > reach ? top - reach : 1;
    const std::size_t last = std::min(without.size(), top + reach + 1);
    const auto both = [&](std::size_t from, std::size_t to) {
        return Json{{"clean", lines_json(without, from, to, resolution_Hz)},
                    {"noisy", lines_json(with, from, to, resolution_Hz)}};
    };
    return {{"whole", both(1, without.size())}, {"zoom", both(first, last)}};
}

}  // namespace gearpod::mc
