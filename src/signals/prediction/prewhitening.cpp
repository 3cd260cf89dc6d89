#include "signals/prediction/prewhitening.hpp"

#include <algorithm>
#include <complex>

#include "signals/spectra/fourier_transform.hpp"

namespace gearpod::signals {

std::vector<double> prewhitened(std::span<const double> samples) {
    constexpr double kRoundingMagnitude = 1e-12;
    const std::size_t n = samples.size();
    std::vector<std::complex<double>> values(samples.begin(), samples.end()), spectrum(n);
    FourierTransform(static_cast<int>(n)).transform(values, spectrum);
    double largest = 0.0;
    for (const auto& value : spectrum) {
        largest = std::max(largest, std::abs(value));
    }
    spectrum[0] = 0.0;
    for (auto& value : spectrum) {
        const double magnitude = std::abs(value);
        value = magnitude > kRoundingMagnitude * largest ? value / magnitude : 0.0;
    }
    FourierTransform(static_cast<int>(n), FourierTransform::Direction::back)
        .transform(spectrum, values);
    std::vector<double> white;
    for (const auto& value : values) {
        white.push_back(value.real() / static_cast<double>(n));
    }
    return white;
}

}  // namespace gearpod::signals
