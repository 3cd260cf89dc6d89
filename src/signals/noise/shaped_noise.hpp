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
#pragma once

#include <complex>
#include <span>
#include <vector>

#include "signals/noise/normals.hpp"

namespace gearpod::signals {

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
