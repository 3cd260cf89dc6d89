// Values of a periodic signal between its samples.
//
// The samples are those of a signal without harmonics above half the sampling rate. It is sampled
// four times as densely with the help of its spectrum, which is exact, and is a cubic B-spline
// between these samples. The error is 3e-5 of a sine at a fifth of the original sampling rate, and
// 5e-4 at two fifths (M. Unser, A. Aldroubi and M. Eden, IEEE Trans. Signal Process. 41 (1993),
// 821-833).
#pragma once

#include <boost/math/interpolators/cardinal_cubic_b_spline.hpp>
#include <complex>
#include <span>
#include <vector>

#include "signals/spectra/fourier_transform.hpp"

namespace gearpod::signals {

// Signal of one period.
class PeriodicSpline {
  public:
    using Spline = boost::math::interpolators::cardinal_cubic_b_spline<double>;
    PeriodicSpline(double samples, Spline spline) : samples_(samples), spline_(std::move(spline)) {}

    // Value at a position in samples from the first one; any number.
    double operator()(double position) const;

  private:
    double samples_;
    Spline spline_;
};

// Holds scratch memory: use one object per thread.
class PeriodicInterpolation {
  public:
    // Number of samples of a period. Throws std::invalid_argument unless it is at least 4.
    explicit PeriodicInterpolation(int samples);

    int samples() const { return forward_.points(); }
    // Throws std::invalid_argument if the period has another length.
    PeriodicSpline spline(std::span<const double> period);

  private:
    FourierTransform forward_, back_;
    std::vector<std::complex<double>> values_, spectrum_, dense_spectrum_, dense_;
};

}  // namespace gearpod::signals
