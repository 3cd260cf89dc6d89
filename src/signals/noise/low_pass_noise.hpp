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

}  // namespace gearpod::signals
