// One-sided amplitude spectrum over one planet turn relative to the carrier. Order k is k cycles
// per planet turn; the mesh frequency and its harmonics are orders Z_p, 2 Z_p, ...
#pragma once

#include <complex>
#include <span>
#include <vector>

#include "signals/spectra/fourier_transform.hpp"

namespace gearpod::signals {

// Spectra of signal + s noise for any number of levels s from one transform. The FFT is linear, and
// a real signal and its real noise share one complex FFT. The signal is its real part, the noise
// its imaginary part, and Hermitian symmetry separates their spectra. Use one object per thread.
class OrderSpectrum {
  public:
    // Throws std::invalid_argument unless points >= 2.
    explicit OrderSpectrum(int points);

    int points() const { return static_cast<int>(buffer_.size()); }
    int orders() const { return points() / 2 + 1; }  // order 0 to the Nyquist order

    // Both spans have points() samples; `noise` may be empty. Before the transform, the noise is
    // scaled to the signal's size by a power of two, so that its rounding errors do not leak into
    // the signal's spectrum. Throws std::invalid_argument otherwise.
    void load(std::span<const double> signal, std::span<const double> noise = {});

    // Amplitudes of signal + noise_factor * noise: a sine of amplitude A at order k gives
    // amplitudes[k] = A.
    void amplitudes(double noise_factor, std::span<double> amplitudes) const;

  private:
    FourierTransform fft_;
    std::vector<std::complex<double>> buffer_;
    std::vector<std::complex<double>> transform_;
    std::vector<std::complex<double>> signal_;  // orders(), scaled to one-sided amplitudes
    std::vector<std::complex<double>> noise_;
};

}  // namespace gearpod::signals
