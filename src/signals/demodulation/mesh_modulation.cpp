#include "signals/demodulation/mesh_modulation.hpp"

#include <numeric>

#include "signals/spectra/fourier_transform.hpp"

namespace gearpod::signals {
namespace {

constexpr double kLeastMeshLine = 1e-12;  // of the sum of all amplitudes; less is rounding

// Mesh harmonic with the largest amplitude; 0 if none is above rounding.
std::size_t strongest_harmonic(std::span<const double> amplitude, std::size_t points,
                               std::size_t teeth, std::size_t half) {
    std::size_t strongest = 0;
    for (std::size_t k = teeth; 2 * (k + half) < points; k += teeth) {
        if (strongest == 0 || amplitude[k] > amplitude[strongest]) {
            strongest = k;
        }
    }
    const double sum = std::accumulate(amplitude.begin(), amplitude.end(), 0.0);
    return strongest > 0 && amplitude[strongest] > kLeastMeshLine * sum ? strongest : 0;
}

}  // namespace

std::vector<std::complex<double>> mesh_modulation(std::span<const double> turn,
                                                  std::span<const double> amplitude, int teeth) {
    const std::size_t n = turn.size();
    const auto half = static_cast<std::size_t>(teeth - 1) / 2;
    const std::size_t carrier =
        strongest_harmonic(amplitude, n, static_cast<std::size_t>(teeth), half);
    if (carrier == 0) {
        return {};
    }
    std::vector<std::complex<double>> band(n), spectrum = spectrum_of(turn);
    // The carrier's order becomes order 0.
    const double scale = 2.0 / static_cast<double>(n);
    for (std::size_t k = 0; k <= half; ++k) {
        band[k] = scale * spectrum[carrier + k];
        band[(n - k) % n] = scale * spectrum[carrier - k];
    }
    FourierTransform(static_cast<int>(n), FourierTransform::Direction::back)
        .transform(band, spectrum);
    return spectrum;
}

}  // namespace gearpod::signals
