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

}  // namespace gearpod::signals
