#include "signals/spectra/speed_variation.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "machine/upper_median.hpp"
#include "signals/spectra/recording_checks.hpp"
#include "signals/spectra/resampling.hpp"

namespace gearpod::signals {
namespace {

constexpr double kLeastOrder = 0.4, kLargestOrder = 6.5;  // of the lines that are compared

double between(const std::vector<double>& values, double position) {
    const auto index = static_cast<std::size_t>(position);
    return index + 1 < values.size()
               ? std::lerp(values[index], values[index + 1], position - static_cast<double>(index))
               : values.back();
}

// Amplitudes of the lines above `noises` times the median, by bin; zeros elsewhere. Interpolates
// the spectrum `finer` times, so that `meshes` bins are one order.
std::vector<double> lines_of(std::span<const double> samples, int per_mesh, double noises,
                             int finer, double& meshes) {
    const auto part = fast_part(samples);
    const auto length = static_cast<int>(part.size());
    meshes = static_cast<double>(finer * length) / per_mesh;
    std::vector<double> lines = hann_amplitudes(part, (finer - 1) * length);
    lines.resize(std::min(lines.size(), static_cast<std::size_t>(kLargestOrder * meshes)));
    const auto low = std::min(lines.size(), static_cast<std::size_t>(kLeastOrder * meshes));
    std::fill_n(lines.begin(), low, 0.0);
    const double limit =
        noises * machine::upper_median(std::vector<double>(
                     lines.begin() + static_cast<std::ptrdiff_t>(low), lines.end()));
    for (double& line : lines) {
        line = line > limit && limit > 0.0 ? line / limit : 0.0;
    }
    return lines;
}

// Mesh phase of every sample, with the mean speed that was assumed.
std::vector<double> followed_phase(std::span<const double> samples, int per_mesh, std::size_t hop) {
    constexpr double kLargestStep = 0.12;  // change of the speed between neighbours
    constexpr double kForgetting = 0.6, kNoises = 2.5;
    std::vector<double> speed{1.0}, before;
    for (std::size_t begin = 0; begin + hop <= samples.size(); begin += hop) {
        double meshes = 0.0;
        std::vector<double> lines =
            lines_of(samples.subspan(begin, hop), per_mesh, kNoises, 2, meshes);
        for (double& line : lines) {
            line = line > 0.0 ? 1.0 + std::log(line) : 0.0;
        }
        before.resize(lines.size());
        double best = 0.0, ratio = speed.back();
        const double step = 0.5 / (meshes * kLargestOrder);
        for (double change = -kLargestStep; change <= kLargestStep; change += step) {
            const double tried = speed.back() * (1.0 + change);
            double both = 0.0;
            for (std::size_t bin = 0; bin < before.size(); ++bin) {
                both += before[bin] > 0.0
                            ? before[bin] * between(lines, static_cast<double>(bin) * tried)
                            : 0.0;
            }
            if (both * std::sqrt(tried) > best) {
                best = both * std::sqrt(tried);
                ratio = tried;
            }
        }
        speed.push_back(ratio);
        for (std::size_t bin = 0; bin < before.size(); ++bin) {
            before[bin] =
                kForgetting * before[bin] + between(lines, static_cast<double>(bin) * ratio);
        }
    }
    // Beyond the middles of the outer parts the speed goes on changing.
    speed[0] = 2.0 * speed[1] - speed[2];
    speed.push_back(2.0 * speed[speed.size() - 1] - speed[speed.size() - 2]);
    std::vector<double> phase{0.0};
    for (std::size_t i = 1; i < samples.size(); ++i) {
        const double parts = static_cast<double>(i) / static_cast<double>(hop);
        phase.push_back(phase.back() + between(speed, parts + 0.5));
    }
    const double scale = static_cast<double>(samples.size() - 1) / (per_mesh * phase.back());
    std::ranges::transform(phase, phase.begin(), [&](double value) { return value * scale; });
    return phase;
}

// How narrow the lines are: the larger, the fewer bins have the power.
double narrowness(std::span<const double> samples, int per_mesh) {
    double power = 0.0, squares = 0.0, meshes = 0.0;
    for (const double line : lines_of(samples, per_mesh, 1.5, 1, meshes)) {
        power += line * line;
        squares += std::pow(line, 4);
    }
    return power > 0.0 ? squares / (power * power) : 0.0;
}

double range(const std::vector<double>& values) {
    const auto [low, high] = std::ranges::minmax(values);
    return high - low;
}

}  // namespace

std::optional<SpeedVariation> speed_variation(std::span<const double> samples, int per_mesh) {
    constexpr std::size_t kFewestParts = 6, kMostParts = 48, kFewestMeshes = 8;  // of a part
    constexpr double kNarrower = 1.15;
    const std::size_t least = kFewestMeshes * static_cast<std::size_t>(per_mesh);
    double narrowest =
        samples.size() < kFewestParts * least ? 0.0 : kNarrower * narrowness(samples, per_mesh);
    std::vector<double> even, found;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        even.push_back(static_cast<double>(i) / per_mesh);
    }
    for (std::size_t parts = kFewestParts; parts <= kMostParts && parts * least <= samples.size();
         parts *= 2) {
        std::vector<double> phase = even, resampled(samples.begin(), samples.end());
        // A second pass follows in finer parts the variation that the first has left.
        for (const std::size_t finer : {1U, 2U}) {
            const std::size_t hop = resampled.size() / parts;
            const std::vector<double> more =
                followed_phase(resampled, per_mesh, hop < 2 * least ? hop : hop / finer);
            for (double& value : phase) {
                const double at = value * per_mesh, end = static_cast<double>(more.size() - 1);
                value = between(more, std::min(at, end)) + std::max(0.0, at - end) / per_mesh;
            }
            const OrderTracking tracking(phase);
            resampled = tracking.resample(samples, per_mesh, tracking.meshes(per_mesh));
            if (const double now = narrowness(resampled, per_mesh); now > narrowest) {
                narrowest = now;
                found = phase;
            }
        }
    }
    if (found.empty()) {
        return std::nullopt;
    }
    const std::size_t hop = samples.size() / (kMostParts / 2);
    std::vector<double> speeds, deviations{0.0};
    for (std::size_t i = hop; i < found.size(); ++i) {
        speeds.push_back((found[i] - found[i - hop]) * per_mesh / static_cast<double>(hop));
        deviations.push_back(found[i] - even[i]);
    }
    return SpeedVariation{range(speeds), range(deviations)};
}

}  // namespace gearpod::signals
