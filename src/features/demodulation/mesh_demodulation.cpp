#include "features/demodulation/mesh_demodulation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "signals/spectra/fourier_transform.hpp"

namespace gearpod::features {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();
constexpr double kLeastMeshLine = 1e-12;  // of the sum of all amplitudes; less is rounding

// Mesh harmonic with the largest amplitude; 0 if none is above rounding.
std::size_t strongest_harmonic(const SensorTurn& sensor, std::size_t half) {
    const auto mesh = static_cast<std::size_t>(sensor.mesh_order);
    std::size_t strongest = 0;
    for (std::size_t k = mesh; 2 * (k + half) < sensor.turn.size(); k += mesh) {
        if (strongest == 0 || sensor.amplitude[k] > sensor.amplitude[strongest]) {
            strongest = k;
        }
    }
    double sum = 0.0;
    for (const double amplitude : sensor.amplitude) {
        sum += amplitude;
    }
    return strongest > 0 && sensor.amplitude[strongest] > kLeastMeshLine * sum ? strongest : 0;
}

}  // namespace

std::vector<std::complex<double>> demodulated_mesh(const SensorTurn& sensor) {
    const std::size_t n = sensor.turn.size();
    const auto half = static_cast<std::size_t>(sensor.mesh_order - 1) / 2;
    const std::size_t carrier = strongest_harmonic(sensor, half);
    if (carrier == 0) {
        return {};
    }
    std::vector<std::complex<double>> band(sensor.turn.begin(), sensor.turn.end()), spectrum(n);
    signals::FourierTransform(static_cast<int>(n)).transform(band, spectrum);
    // The carrier's order becomes order 0.
    std::fill(band.begin(), band.end(), 0.0);
    for (std::size_t k = 0; k <= half; ++k) {
        band[k] = 2.0 / static_cast<double>(n) * spectrum[carrier + k];
        band[(n - k) % n] = 2.0 / static_cast<double>(n) * spectrum[carrier - k];
    }
    signals::FourierTransform(static_cast<int>(n), signals::FourierTransform::Direction::back)
        .transform(band, spectrum);
    return spectrum;
}

double amplitude_modulation(const SensorTurn& sensor) {
    const auto signal = demodulated_mesh(sensor);
    double sum = 0.0;
    for (const auto& value : signal) {
        sum += std::abs(value);
    }
    const double mean = sum / static_cast<double>(signal.size());
    double largest = signal.empty() ? kNoValue : 0.0;
    for (const auto& value : signal) {
        largest = std::max(largest, std::abs(std::abs(value) / mean - 1.0));
    }
    return largest;
}

double phase_modulation(const SensorTurn& sensor) {
    const auto signal = demodulated_mesh(sensor);
    if (signal.empty()) {
        return kNoValue;
    }
    double phase = 0.0, low = 0.0, high = 0.0;
    for (std::size_t i = 1; i < signal.size(); ++i) {
        phase += std::arg(signal[i] * std::conj(signal[i - 1]));
        low = std::min(low, phase);
        high = std::max(high, phase);
    }
    return high - low;
}

}  // namespace gearpod::features
