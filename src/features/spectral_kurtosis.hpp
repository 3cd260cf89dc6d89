// Spectral kurtosis of the residual signal, and the kurtogram's peak.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <vector>

#include "features/signals.hpp"
#include "machine/no_value.hpp"
#include "signals/demodulation/demodulation.hpp"
#include "signals/spectra/fourier_transform.hpp"

namespace gearpod::features {

// Spectral kurtosis of the residual signal, the largest one over the frequency bands:
//
//     SK(m) = <|X_k(m)|^4> / <|X_k(m)|^2>^2 - 2,
//
// where X_k are short-time Fourier transforms and <> is their mean over k. Antoni, Mech. Syst.
// Signal Process. 20 (2006) 282-307. It is 0 for stationary Gaussian noise, -1 for a tone, and
// K - 2 for one impulse in K frames.
//
// Frames are one mesh period long, under a periodic Hann window, and overlap by half. The averaged
// turn is periodic, so there are K = 2 Z_p of them. In Gaussian noise the estimate of one band
// scatters by about 2 / sqrt(K), and the largest one is therefore above 0. Bands whose mean power
// is below 1e-12 of the strongest band's contain rounding errors only and are left out.
inline double spectral_kurtosis(const SensorTurn& sensor) {
    constexpr double kRounding = 1e-12;
    const std::span<const double> x = sensor.residual;
    const auto frames = 2 * static_cast<std::size_t>(sensor.mesh_order);
    const std::size_t points = 2 * x.size() / frames;
    signals::FourierTransform transform(static_cast<int>(points));
    std::vector<std::complex<double>> frame(points), spectrum(points);
    std::vector<double> square((points + 1) / 2, 0.0), fourth(square);  // [band], 0 is not used
    for (std::size_t k = 0; k < frames; ++k) {
        for (std::size_t i = 0; i < points; ++i) {
            const double angle =
                2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(points);
            frame[i] = (0.5 - 0.5 * std::cos(angle)) * x[(k * points / 2 + i) % x.size()];
        }
        transform.transform(frame, spectrum);
        for (std::size_t m = 1; m < square.size(); ++m) {
            const double power = std::norm(spectrum[m]);
            square[m] += power;
            fourth[m] += power * power;
        }
    }
    const double strongest = *std::max_element(square.begin(), square.end());
    double largest = -std::numeric_limits<double>::infinity();
    for (std::size_t m = 1; m < square.size(); ++m) {
        if (square[m] > kRounding * strongest) {
            const double kurtosis =
                static_cast<double>(frames) * fourth[m] / (square[m] * square[m]) - 2.0;
            largest = std::max(largest, kurtosis);
        }
    }
    return std::isfinite(largest) ? largest : kNan;
}

// Largest kurtosis of the complex envelope of the sensor samples over the bands of the kurtogram
// (signals/demodulation/demodulation.hpp). Antoni (2007).
//
// The levels end before the bands become narrower than a mesh order, so that an envelope still
// resolves single teeth. The value is 0 for stationary Gaussian noise, apart from the scatter of
// the largest of the bands: 2 / sqrt(C) for one band of C orders. NaN for a signal of rounding
// errors.
inline signals::Kurtogram kurtogram_of(const SensorSamples& sensor, const SensorTurn& average) {
    const std::size_t per_mesh = average.turn.size() / static_cast<std::size_t>(average.mesh_order);
    return {sensor.samples, per_mesh / 2};
}

inline double kurtogram_peak(const SensorSamples& sensor, const SensorTurn& average) {
    const signals::Kurtogram kurtogram = kurtogram_of(sensor, average);
    return kurtogram.peak() == nullptr ? kNan : kurtogram.peak()->kurtosis;
}

}  // namespace gearpod::features
