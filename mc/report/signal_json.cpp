#include "mc/report/signal_json.hpp"

#include <algorithm>

#include "mc/report/thinning.hpp"
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

}  // namespace

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
