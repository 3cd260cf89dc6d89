// Filters and correlations of one periodic signal x of n samples, by products of spectra.
#pragma once

#include <complex>
#include <span>
#include <vector>

#include "signals/spectra/fourier_transform.hpp"

namespace gearpod::signals {

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
    // (1/n) sum over i of y_i x_((i-l) mod n) for l = 0 to `lags` - 1; `y` has n values.
    std::vector<double> correlated(std::span<const double> y, std::size_t lags);

  private:
    // Spectrum of values followed by zeros, in product_.
    void transform(std::span<const double> values);
    // First `count` samples of the signal with the spectrum product_.
    std::vector<double> signal(std::size_t count);

    FourierTransform forward_, backward_;
    std::vector<std::complex<double>> spectrum_, values_, product_;
};

}  // namespace gearpod::signals
