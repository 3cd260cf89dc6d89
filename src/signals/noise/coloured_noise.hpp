// Noise that is white before the sensor's anti-alias low-pass (Butterworth, order 4) and is sampled
// after it. The samples are stationary and Gaussian, of variance D^2 B for a one-sided density D.
// The noise bandwidth of the low-pass is
//
//     B = integral of |H|^2 = f_c (pi/8) / sin(pi/8)
//
// and the autocovariance is the sum over its poles of c_k exp(p_k |tau|). The samples have exactly
// that distribution, aliases included, from the first sample on. They are generated from the same
// number of independent normal variates by the innovations model. Its gains follow from a Riccati
// recursion (Anderson and Moore, Optimal Filtering (1979), section 9.3).
#pragma once

#include <array>
#include <complex>
#include <span>
#include <vector>

#include "signals/noise/normals.hpp"

namespace gearpod::signals {

// Noise bandwidth B of the low-pass, Hz.
double low_pass_noise_bandwidth_Hz(double low_pass_Hz);

class LowPassNoise {
  public:
    // Smallest product of f_c and the sampling interval with accurate statistics. Below it,
    // adjacent samples are so similar that rounding changes their distribution (by more than 1e-8
    // of the variance).
    static constexpr double kLeast = 0.02;
    // `low_pass_per_sample` is f_c times the sampling interval. Throws std::invalid_argument unless
    // it is above kLeast / 4 and finite.
    explicit LowPassNoise(double low_pass_per_sample);

    // Turns independent standard normals into correlated samples of variance 1, in place.
    void colour(std::span<double> samples) const;

    // Fills `samples` with noise of variance 1. The first samples do not depend on the number of
    // samples. Engine: a 64-bit uniform random bit generator.
    template <typename Engine>
    void draw(Engine& engine, std::span<double> samples) const {
        draw_normals(engine, samples);
        colour(samples);
    }

  private:
    using State = std::array<double, 4>;  // real and imaginary parts of two pairs of poles
    // Gain of one sample: the rms of its innovation, and the effect of the innovation on the state.
    struct Gain {
        double rms = 0;
        State state{};
    };

    std::array<double, 2> real_{}, imaginary_{};  // parts of exp(p dt)
    std::vector<Gain> gains_;  // of the first samples; the last entry serves all later samples
};

// Gaussian noise with a given power density before the sensor's anti-alias low-pass (Butterworth,
// order 4): the background of a machine. With the one-sided density D(f)^2, the samples have the
// density D(f)^2 |H(f)|^2, frequencies above half the sampling rate being aliased.
//
// The samples are independent normal variates, convolved with a filter of kTaps coefficients. Its
// frequency response is the root of the samples' density at kTaps frequencies, under a Hann window.
// The density is thereby smoothed over about two of these frequencies, 2 / kTaps of the sampling
// rate. The convolution uses Fourier transforms of fixed length (overlap and add: T. G. Stockham,
// AFIPS Spring Joint Computer Conf. 28 (1966), 229-233), so that the first samples do not depend on
// the number of samples.

// Density as a function of frequency: straight lines between the given points on logarithmic axes,
// 0 outside of them.
struct NoiseSpectrum {
    std::vector<double> frequency_Hz;              // ascending, above 0, at least two
    std::vector<double> density_m_s2_per_sqrt_Hz;  // above 0

    // D at f Hz, m/s^2 / sqrt(Hz).
    double at(double f) const;
    // Standard deviation after the low-pass, m/s^2: the root of the integral of D^2 |H|^2.
    double rms_m_s2(double low_pass_Hz) const;
};

class ShapedNoise {
  public:
    static constexpr int kTaps = 4096;
    // Throws std::invalid_argument unless the spectrum is as stated, the frequencies are positive
    // and finite, and some of the density passes.
    ShapedNoise(const NoiseSpectrum& spectrum, double low_pass_Hz, double sampling_Hz);

    // Fills `samples` with noise of variance 1. Engine: a 64-bit uniform random bit generator.
    template <typename Engine>
    void draw(Engine& engine, std::span<double> samples) const {
        // Whole pairs of blocks: the last samples then have the same bits whatever follows them.
        const std::size_t pairs = 1 + samples.size() / (2 * kTaps);
        std::vector<double> normals(pairs * 2 * kTaps + kTaps);
        draw_normals(engine, std::span(normals));
        filter(normals, samples);
    }

  private:
    // samples[i] = sum over j of filter[j] normals[i + kTaps - j]. The normals are one block of
    // kTaps and whole pairs of such blocks.
    void filter(std::span<const double> normals, std::span<double> samples) const;

    std::vector<std::complex<double>> response_;  // of the filter, at 2 kTaps frequencies
};

}  // namespace gearpod::signals
