#include "signals/windowing/planet_separation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "signals/spectra/synchronous_average.hpp"

namespace gearpod::signals {
namespace {

constexpr double kEqualEnergies = 1e-12;  // relative difference of energies that count as equal

std::vector<double> passage_window(std::size_t points) {
    std::vector<double> window;
    for (std::size_t i = 0; i < points; ++i) {
        window.push_back(0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * static_cast<double>(i) /
                                              static_cast<double>(points)));
    }
    return window;
}

// First sample of the windows with the largest energy. `offsets`: those of the planets. `folded`:
// squares over the carrier turn.
std::size_t best_passage(std::span<const double> folded, std::span<const std::size_t> offsets,
                         std::span<const double> window) {
    const std::size_t spacing = (folded.size() + offsets.size() - 1) / offsets.size();
    std::vector<double> energy(spacing, 0.0);
    for (std::size_t c = 0; c < spacing; ++c) {
        for (const std::size_t offset : offsets) {
            for (std::size_t m = 0; m < window.size(); ++m) {
                energy[c] += window[m] * window[m] * folded[(c + offset + m) % folded.size()];
            }
        }
    }
    const double largest = *std::max_element(energy.begin(), energy.end());
    const auto first = std::find_if(energy.begin(), energy.end(), [&](double one) {
        return one >= (1.0 - kEqualEnergies) * largest;
    });
    return static_cast<std::size_t>(first - energy.begin());
}

}  // namespace

std::vector<std::vector<double>> planet_averages(std::span<const double> samples,
                                                 const SpanLayout& span, int planets,
                                                 int per_mesh) {
    const auto teeth = static_cast<std::size_t>(span.planet_teeth);
    const auto points = static_cast<std::size_t>(per_mesh);
    const std::size_t carrier = static_cast<std::size_t>(span.carrier_meshes) * points;
    const std::size_t passages = samples.size() / carrier / teeth * teeth;
    if (span.carrier_meshes == 1 || passages == 0 ||
        std::gcd(span.planet_teeth, span.carrier_meshes) != 1) {
        return {};
    }
    const std::span<const double> used = samples.first(passages * carrier);
    std::vector<std::size_t> offsets;
    for (std::size_t p = 0; p < static_cast<std::size_t>(planets); ++p) {
        offsets.push_back(p * carrier / static_cast<std::size_t>(planets));
    }
    const std::vector<double> window = passage_window(2 * points);
    const std::size_t first = best_passage(fold_of_squares(used, carrier), offsets, window);
    const double share = static_cast<double>(teeth) / static_cast<double>(passages);
    std::vector<std::vector<double>> averages;
    for (const std::size_t offset : offsets) {
        std::vector<double>& average = averages.emplace_back(teeth * points, 0.0);
        for (std::size_t k = 0; k < passages; ++k) {
            for (std::size_t m = 0; m < window.size(); ++m) {
                const std::size_t at = k * carrier + first + offset + m;
                average[at % average.size()] += share * window[m] * used[at % used.size()];
            }
        }
    }
    return averages;
}

}  // namespace gearpod::signals
