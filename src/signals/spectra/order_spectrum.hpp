// One-sided amplitude spectrum over one planet turn relative to the carrier. Order k is k cycles
// per planet turn; the mesh frequency and its harmonics are orders Z_p, 2 Z_p, ...
#pragma once

#include <complex>
#include <span>
#include <vector>

#include "signals/spectra/fourier_transform.hpp"

namespace gearpod::signals {

// Spectra of signal + s noise for any number of levels s from one transform: the FFT is linear, and
// a signal and its noise, both real, share one complex FFT (signal in the real part, noise in the
// imaginary part, told apart by Hermitian symmetry). One object per thread.
class OrderSpectrum {
  public:
    // Throws std::invalid_argument unless points >= 2.
    explicit OrderSpectrum(int points);

    int points() const { return static_cast<int>(buffer_.size()); }
    int orders() const { return points() / 2 + 1; }  // order 0 to the Nyquist order

    // Both of points() samples; `noise` may be empty. The noise is scaled to the signal's size by a
    // power of two meanwhile, so that its rounding does not leak into the signal's spectrum. Throws
    // std::invalid_argument otherwise.
    void load(std::span<const double> signal, std::span<const double> noise = {});

    // amplitudes[k] of signal + noise_factor * noise: a sine of amplitude A at order k gives A.
    void amplitudes(double noise_factor, std::span<double> amplitudes) const;

  private:
    FourierTransform fft_;
    std::vector<std::complex<double>> buffer_;
    std::vector<std::complex<double>> transform_;
    std::vector<std::complex<double>> signal_;  // orders(), scaled to one-sided amplitudes
    std::vector<std::complex<double>> noise_;
};

}  // namespace gearpod::signals
