// Spectra of a planet turn, the separation of regular meshing from the rest, and the speed error.
#pragma once

#include <complex>
#include <span>
#include <vector>

#include "signals/spectra/fourier_transform.hpp"

namespace gearpod::signals {

// One-sided amplitude spectrum over one planet turn relative to the carrier. Order k is k cycles
// per planet turn; the mesh frequency and its harmonics are orders Z_p, 2 Z_p, ...

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

// Splits the time-synchronous average into regular, residual and difference signals.
//
// The signals are those of condition indicators after Lebold et al., "Review of vibration analysis
// methods for gearbox diagnostics and prognostics", Proc. 54th MFPT (2000), and Samuel and Pines,
// J. Sound Vib. 282 (2005) 475-508. In orders of a turn of the gear with T teeth, x being the
// averaged turn:
//
//     regular     x at the mesh harmonics j T and their first sidebands j T - 1, j T + 1 (j >= 1)
//     residual    x without its mean and the mesh harmonics
//     difference  x without its mean and the regular signal
//
// all up to the Nyquist order.

// Holds scratch memory: use one object per thread.
class MeshSeparation {
  public:
    // `points` is the number of samples of a turn of `teeth` teeth. Throws std::invalid_argument
    // unless teeth >= 3 and points >= 4 teeth.
    MeshSeparation(int points, int teeth);

    // Separates a turn. Throws std::invalid_argument unless it has points() samples.
    void load(std::span<const double> turn);

    int points() const { return static_cast<int>(regular_.size()); }
    // Signals of the turn loaded last, points() samples each.
    std::span<const double> regular() const { return regular_; }
    std::span<const double> residual() const { return residual_; }
    std::span<const double> difference() const { return difference_; }
    // One-sided amplitudes of that turn, order 0 to the Nyquist order.
    std::span<const double> amplitude() const { return amplitude_; }

  private:
    enum class Kind : unsigned char { other, sideband, harmonic };

    FourierTransform forward_, backward_;
    std::vector<Kind> kind_;  // of every order from 0 to the Nyquist order; the mean is `other`
    std::vector<std::complex<double>> spectrum_, part_, back_;
    std::vector<double> regular_, residual_, difference_, amplitude_;
};

// Speed error: derivative of the averaged transmission error with respect to the angle of the turn.

// With n samples of a turn and their Fourier transform TE_k,
//
//     v(t) = IDFT(i k TE_k),   |k| < n / 2,
//
// in rad per radian of the turn. The length of `turn` is the length of the result.
std::vector<double> speed_error(std::span<const double> turn);

}  // namespace gearpod::signals
