// Inverse filters of a periodic signal: linear prediction, minimum-entropy deconvolution and
// cepstral pre-whitening.
#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "signals/spectra/fourier_transform.hpp"

namespace gearpod::signals {

// Solution x of sum over j of r_|i-j| x_j = b_i by Levinson's recursion; N. Levinson, J. Math.
// Phys. 25 (1947) 261-278. The matrix is positive definite.
std::vector<double> solve_toeplitz(std::span<const double> r, std::span<const double> b);

// Filters and correlations of one periodic signal x of n samples, by products of spectra.

// Holds scratch memory: use one object per thread.
class PeriodicSignal {
  public:
    explicit PeriodicSignal(std::span<const double> samples);

    // Autocorrelation r_k = (1/n) sum over i of x_i x_((i+k) mod n) for k = 0 to `lags` - 1, with
    // 1e-9 of r_0 added to r_0. This white-noise correction (-90 dB) bounds the condition number of
    // the Toeplitz matrix by about 1e9 times its size, so that tones without noise have a solution,
    // too.
    std::vector<double> corrected_autocorrelation(std::size_t lags);
    // y_i = sum over l of f_l x_((i-l) mod n), n values.
    std::vector<double> filtered(std::span<const double> filter);
    // (1/n) sum over i of y_i x_((i-l) mod n) for l = 0 to `lags` - 1.
    std::vector<double> correlated(std::span<const double> y, std::size_t lags);

  private:
    // Spectrum of values followed by zeros, in product_.
    void transform(std::span<const double> values);
    // First `count` samples of the signal with the spectrum product_.
    std::vector<double> signal(std::size_t count);

    FourierTransform forward_, backward_;
    std::vector<std::complex<double>> spectrum_, values_, product_;
};

// Minimum-entropy deconvolution: R. A. Wiggins, Geoexploration 16 (1978) 21-35; for gear faults: H.
// Endo and R. B. Randall, Mech. Syst. Signal Process. 21 (2007) 906-919.

// Periodic signal x filtered by the `length` coefficients f that make the result y as impulsive as
// possible. f starts as an impulse at length / 2. Each of `iterations` solves
//
//     sum over m of r_|l-m| f_m = sum over i of y_i^3 x_(i-l),   l = 0 to length - 1,
//
// with the autocorrelation r of x, and scales y to an RMS of 1. These are the
// conditions for a stationary kurtosis of y. Few iterations may stop short of the maximum.
std::vector<double> deconvolve(std::span<const double> x, std::size_t length, int iterations);

// Cepstral pre-whitening: P. Borghesani, P. Pennacchi, R. B. Randall, N. Sawalhi and R. Ricci,
// Mech. Syst. Signal Process. 36 (2013) 370-384.

// Holds the transforms of one length: use one object per thread.
class Prewhitening {
  public:
    // `points` is the number of samples.
    explicit Prewhitening(int points);

    int points() const { return forward_.points(); }

    // Signal with the same phase spectrum and unit magnitudes: x_w = IDFT(X / |X|), which sets the
    // real cepstrum to zero except at zero quefrency. Mesh lines and resonances lose their
    // dominance, and impulses remain. Orders below 1e-12 of the largest magnitude, and the mean,
    // become 0. Throws std::invalid_argument unless there are points() samples.
    std::vector<double> whitened(std::span<const double> samples);

  private:
    FourierTransform forward_, backward_;
    std::vector<std::complex<double>> values_, spectrum_;
};

}  // namespace gearpod::signals
