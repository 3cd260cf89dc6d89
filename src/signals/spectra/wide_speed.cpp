#include "signals/spectra/wide_speed.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "machine/upper_median.hpp"
#include "signals/spectra/recording_checks.hpp"

namespace gearpod::signals {
namespace {

constexpr double kLeastRatio = 0.19, kLargestRatio = 5.3;  // of the searched speeds
constexpr int kMostWideHarmonics = 8;                      // of a mesh that are compared
constexpr double kWideLineSpread = 4.0;      // of the lines around a harmonic, in turn frequencies
constexpr double kLargestSpread = 0.05;      // the same, in mesh frequencies
constexpr double kComparableWideFit = 0.85;  // fraction of the best fit
constexpr std::size_t kMostLines = 80;       // strongest lines that are compared

struct WideLine {
    double order;   // per mesh
    double weight;  // logarithm of its power over the noise
};

// Lines above the noise, which is the median of the amplitudes around them. In Gaussian noise a
// spectrum has a peak above this limit in one of twenty recordings.
std::vector<WideLine> strongest_lines(const std::vector<double>& amplitude, double meshes) {
    constexpr std::size_t kBands = 8, kNarrowest = 40;
    constexpr double kOfLargest = 0.02;  // smaller peaks may be skirts of stronger lines
    constexpr double kLargestWeight = 8.0;
    const double limit = std::log(static_cast<double>(amplitude.size())) + 3.0;
    const std::size_t width = std::max(kNarrowest, amplitude.size() / kBands), hop = width / 4;
    std::vector<WideLine> lines;
    for (std::size_t begin = 2; begin + 1 < amplitude.size(); begin += hop) {
        const std::size_t end = std::min(begin + hop, amplitude.size() - 1);
        const std::size_t middle = begin + hop / 2;
        const std::size_t from = std::min(middle > width / 2 ? middle - width / 2 : 0,
                                          amplitude.size() > width ? amplitude.size() - width : 0);
        const std::vector<double> band(amplitude.begin() + static_cast<std::ptrdiff_t>(from),
                                       amplitude.begin() + static_cast<std::ptrdiff_t>(std::min(
                                                               from + width, amplitude.size())));
        const double least =
            std::max(machine::upper_median(band) * std::sqrt(limit / std::numbers::ln2),
                     kOfLargest * *std::ranges::max_element(band));
        for (std::size_t bin = begin; bin < end; ++bin) {
            const double here = amplitude[bin], below = amplitude[bin - 1],
                         above = amplitude[bin + 1];
            if (here > least && here >= below && here > above) {
                const double bend = below - 2.0 * here + above;
                const double part = bend < 0.0 ? 0.5 * (below - above) / bend : 0.0;
                lines.push_back(
                    {(static_cast<double>(bin) + part) / meshes,
                     std::min(kLargestWeight, 2.0 * std::log(here / least) + std::log(limit))});
            }
        }
    }
    std::ranges::sort(lines, std::greater<>(), &WideLine::weight);
    lines.resize(std::min(lines.size(), kMostLines));
    return lines;
}

class Comb {
  public:
    Comb(const std::vector<WideLine>& lines, double largest_order, double meshes, int turn_meshes)
        : lines_(lines), largest_order_(largest_order), meshes_(meshes), teeth_(turn_meshes) {
        for (const WideLine& line : lines) {
            all_ += line.weight;
        }
    }

    // Fraction of the lines' weights that the comb stretched by `ratio` covers, times the fraction
    // of the comb's harmonics that have lines. `harmonics`: their number.
    double fit(double ratio, int* harmonics = nullptr) const {
        constexpr double kFewestCombTurns = 3.0;  // that separate the teeth of the comb
        const double turns = meshes_ * ratio / teeth_;
        const bool teeth = teeth_ > 1 && turns >= kFewestCombTurns;
        const double width = teeth ? std::min(0.33, 1.5 / turns) : 0.0;
        const double spread = std::max(
            teeth_ > 1 ? std::min(kWideLineSpread / teeth_, kLargestSpread) : 0.4 * kLargestSpread,
            1.0 / (meshes_ * ratio));
        std::array<double, kMostWideHarmonics + 1> of_harmonic{};
        double on = 0.0;
        for (const WideLine& line : lines_) {
            const double order = line.order / ratio, harmonic = std::max(1.0, std::round(order));
            const double offset = order - harmonic;
            if (std::abs(offset) > 3.0 * spread) {
                continue;
            }
            double covered = line.weight * std::exp(-0.5 * std::pow(offset / spread, 2));
            if (teeth) {
                const double in_teeth = offset * teeth_;
                covered *= std::max(0.0, 1.0 - std::abs(in_teeth - std::round(in_teeth)) / width);
            }
            on += covered;
            if (harmonic <= kMostWideHarmonics) {
                double& most = of_harmonic[static_cast<std::size_t>(harmonic)];
                most = std::max(most, covered);
            }
        }
        const double least = 0.1 * *std::ranges::max_element(of_harmonic);
        int present = 0, highest = 1;
        for (int k = 1; k <= kMostWideHarmonics && k * ratio < largest_order_; ++k) {
            if (of_harmonic[static_cast<std::size_t>(k)] > least) {
                ++present;
                highest = k;
            }
        }
        if (harmonics != nullptr) {
            *harmonics = present;
        }
        return all_ > 0.0 ? on / all_ * present / highest : 0.0;
    }

  private:
    const std::vector<WideLine>& lines_;
    double largest_order_, meshes_, all_ = 0.0;
    int teeth_;
};

}  // namespace

std::optional<WideSpeed> wide_speed(std::span<const double> samples, double per_mesh,
                                    int turn_meshes) {
    constexpr double kFewestMeshes = 20.0;
    samples = fast_part(samples);
    const double meshes = static_cast<double>(samples.size()) / per_mesh;
    if (meshes < kFewestMeshes || per_mesh < 2.0) {
        return std::nullopt;
    }
    const std::vector<WideLine> lines = strongest_lines(hann_amplitudes(samples), meshes);
    const Comb comb(lines, 0.5 * per_mesh, meshes, turn_meshes);
    WideSpeed best;
    for (const double part : {-0.25, 0.0, 0.25}) {
        best.stated = std::max(best.stated, comb.fit(1.0 + part / meshes));
    }
    best.fit = best.stated;
    best.lines = static_cast<int>(lines.size());
    const double step = 0.25 / (meshes * kMostWideHarmonics);
    std::vector<std::pair<double, double>> fits;  // ratio and fit
    for (double ratio = kLeastRatio; ratio <= kLargestRatio; ratio += step * ratio) {
        fits.emplace_back(ratio, comb.fit(ratio));
    }
    for (const auto& [ratio, fit] : fits) {
        if (fit > best.fit) {
            best.ratio = ratio;
            best.fit = fit;
        }
    }
    comb.fit(best.ratio, &best.harmonics);
    double best_other_fit = kComparableWideFit * best.fit;
    for (const auto& [ratio, fit] : fits) {
        if (fit > best_other_fit &&
            std::abs(ratio / best.ratio - 1.0) > 0.5 / std::max(turn_meshes, 10)) {
            best.other = ratio;
            best_other_fit = fit;
        }
    }
    return best;
}

}  // namespace gearpod::signals
