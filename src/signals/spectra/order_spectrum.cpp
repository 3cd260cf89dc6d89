#include "signals/spectra/order_spectrum.hpp"

#include <cmath>
#include <numeric>
#include <stdexcept>

namespace gearpod::signals {
namespace {

int checked(int points) {
    if (points < 2) {
        throw std::invalid_argument("order spectrum: needs two or more points");
    }
    return points;
}

// Power of two that brings b's rms close to a's; 1 if either vanishes.
double balancing_power_of_two(std::span<const double> a, std::span<const double> b) {
    const auto square = [](std::span<const double> x) {
        return std::inner_product(x.begin(), x.end(), x.begin(), 0.0);
    };
    const double size = square(b);
    const double ratio = size > 0.0 ? square(a) / size : 0.0;
    return ratio > 0.0 && std::isfinite(ratio) ? std::ldexp(1.0, std::ilogb(ratio) / 2) : 1.0;
}

int checked(int points, int teeth) {
    if (teeth < 3 || points < 4 * teeth) {
        throw std::invalid_argument(
            "mesh separation: needs three or more teeth and four samples a tooth");
    }
    return points;
}

}  // namespace

OrderSpectrum::OrderSpectrum(int points)
    : fft_(checked(points)), buffer_(points), transform_(points) {
    signal_.resize(orders());
    noise_.resize(orders());
}

void OrderSpectrum::load(std::span<const double> signal, std::span<const double> noise) {
    const std::size_t n = buffer_.size();
    if (signal.size() != n || (!noise.empty() && noise.size() != n)) {
        throw std::invalid_argument("order spectrum: signal and plan disagree in size");
    }
    const double balance = noise.empty() ? 1.0 : balancing_power_of_two(signal, noise);
    for (std::size_t i = 0; i < n; ++i) {
        buffer_[i] = {signal[i], noise.empty() ? 0.0 : balance * noise[i]};
    }
    fft_.transform(buffer_, transform_);
    for (std::size_t k = 0; k < signal_.size(); ++k) {
        // Z_k = A_k + i B_k with A, B Hermitian: A = (Z_k + conj Z_{n-k})/2, B = (Z_k - ...)/2i.
        const std::complex<double> z = transform_[k];
        const std::complex<double> mirrored = std::conj(transform_[k == 0 ? 0 : n - k]);
        const bool paired = k != 0 && 2 * k != n;
        const double scale = (paired ? 1.0 : 0.5) / static_cast<double>(n);
        const std::complex<double> sum = z + mirrored;
        const std::complex<double> difference = z - mirrored;
        signal_[k] = scale * sum;
        const double unscale = scale / balance;
        noise_[k] = {unscale * difference.imag(), -unscale * difference.real()};
    }
}

void OrderSpectrum::amplitudes(double noise_factor, std::span<double> amplitudes) const {
    if (amplitudes.size() != signal_.size()) {
        throw std::invalid_argument("order spectrum: amplitudes must have one value per order");
    }
    for (std::size_t k = 0; k < signal_.size(); ++k) {
        const double re = signal_[k].real() + noise_factor * noise_[k].real();
        const double im = signal_[k].imag() + noise_factor * noise_[k].imag();
        amplitudes[k] = std::sqrt(re * re + im * im);
    }
}

MeshSeparation::MeshSeparation(int points, int teeth)
    : forward_(checked(points, teeth)),
      backward_(points, FourierTransform::Direction::back),
      kind_(static_cast<std::size_t>(points) / 2 + 1, Kind::other) {
    const auto n = static_cast<std::size_t>(points);
    for (std::size_t k = 1; 2 * k <= n; ++k) {
        const auto mesh = static_cast<std::size_t>(teeth);
        if (k % mesh == 0) {
            kind_[k] = Kind::harmonic;
        } else if (k + 1 >= mesh && (k % mesh == 1 || k % mesh == mesh - 1)) {
            kind_[k] = Kind::sideband;
        }
    }
    for (auto* buffer : {&spectrum_, &part_, &back_}) {
        buffer->resize(n);
    }
    for (auto* signal : {&regular_, &residual_, &difference_}) {
        signal->resize(n);
    }
    amplitude_.resize(kind_.size());
}

void MeshSeparation::load(std::span<const double> turn) {
    const std::size_t n = regular_.size();
    if (turn.size() != n) {
        throw std::invalid_argument("mesh separation: the turn has another number of samples");
    }
    for (std::size_t i = 0; i < n; ++i) {
        part_[i] = turn[i];
    }
    forward_.transform(part_, spectrum_);
    const double scale = 1.0 / static_cast<double>(n);
    for (std::size_t k = 0; k < kind_.size(); ++k) {
        const bool paired = k != 0 && 2 * k != n;
        amplitude_[k] = (paired ? 2.0 : 1.0) * scale * std::abs(spectrum_[k]);
    }
    // Harmonics in the real part and sidebands in the imaginary part share one inverse transform,
    // because both are real signals.
    const std::complex<double> i_unit(0.0, 1.0);
    for (std::size_t k = 0; k < n; ++k) {
        const Kind kind = kind_[std::min(k, n - k)];
        part_[k] = kind == Kind::harmonic   ? spectrum_[k]
                   : kind == Kind::sideband ? i_unit * spectrum_[k]
                                            : 0.0;
    }
    backward_.transform(part_, back_);
    const double mean = scale * spectrum_[0].real();
    for (std::size_t i = 0; i < n; ++i) {
        const double harmonics = scale * back_[i].real();
        const double sidebands = scale * back_[i].imag();
        regular_[i] = harmonics + sidebands;
        residual_[i] = turn[i] - mean - harmonics;
        difference_[i] = residual_[i] - sidebands;
    }
}

std::vector<double> speed_error(std::span<const double> turn) {
    const std::size_t n = turn.size();
    std::vector<std::complex<double>> spectrum = spectrum_of(turn);
    for (std::size_t k = 0; k < n; ++k) {
        const double order = 2 * k == n  ? 0.0
                             : 2 * k < n ? static_cast<double>(k)
                                         : static_cast<double>(k) - static_cast<double>(n);
        spectrum[k] *= std::complex<double>(0.0, order);
    }
    return signal_of(spectrum);
}

}  // namespace gearpod::signals
