// Order tracking: resamples a signal sampled evenly in time to an even grid of mesh phase.
#pragma once

#include <boost/math/interpolators/cardinal_cubic_b_spline.hpp>
#include <complex>
#include <span>
#include <vector>

#include "signals/spectra/fourier_transform.hpp"

namespace gearpod::signals {

// Mesh phases of the samples of a recording. Between samples the phase is linear and a signal is
// its cubic B-spline interpolant. The interpolation error grows with the fourth power of the
// frequency: 5e-4 of a sine at a tenth of the sampling rate, 1e-2 at a fifth (Unser, Aldroubi and
// Eden, IEEE Trans. Signal Process. 41 (1993) 821). It is larger within a few samples of the ends.
// Grid points that fall on a sample take its value.
class OrderTracking {
  public:
    // `phase`: mesh phase of every sample, in mesh periods. Throws std::invalid_argument unless it
    // has two or more values and increases strictly.
    explicit OrderTracking(std::vector<double> phase);

    // Number of whole mesh periods that the recording covers on a grid of `per_mesh` points per
    // mesh.
    int meshes(int per_mesh) const;

    // Signal at phases phase[0] + i / per_mesh, i < meshes * per_mesh. Throws std::invalid_argument
    // if the signal or the recording is too short.
    std::vector<double> resample(std::span<const double> signal, int per_mesh, int meshes) const;

  private:
    std::vector<double> phase_;
};

// Values of a periodic signal between its samples.
//
// The samples are those of a signal without harmonics above half the sampling rate. It is sampled
// four times as densely with the help of its spectrum, which is exact, and is a cubic B-spline
// between these samples. The error is 3e-5 of a sine at a fifth of the original sampling rate, and
// 5e-4 at two fifths (M. Unser, A. Aldroubi and M. Eden, IEEE Trans. Signal Process. 41 (1993),
// 821-833).

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
