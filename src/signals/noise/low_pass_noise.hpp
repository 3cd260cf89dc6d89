// Noise that is white before the sensor's anti-alias low-pass (Butterworth, order 4) and is sampled
// behind it: stationary and Gaussian, of variance D^2 B for a one-sided density D, with the
// low-pass' noise bandwidth
//
//     B = integral of |H|^2 = f_c (pi/8) / sin(pi/8)
//
// and the autocovariance sum over its poles of c_k exp(p_k |tau|). The samples have exactly that
// law, aliases included: they are made of as many independent normals by the innovations model
// whose gains a Riccati recursion gives (Anderson and Moore, Optimal Filtering (1979),
// section 9.3), from the first sample on.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "signals/noise/normals.hpp"

namespace gearpod::signals {

// B, Hz.
double low_pass_noise_bandwidth_Hz(double low_pass_Hz);

class LowPassNoise {
  public:
    // f_c times the time between two samples. Below kLeast the samples are so alike that rounding
    // shows in their law (beyond 1e-8 of the variance).
    static constexpr double kLeast = 0.02;
    // Throws std::invalid_argument unless that is above kLeast / 4 and finite.
    explicit LowPassNoise(double low_pass_per_sample);

    // Independent standard normals become samples of variance 1.
    void colour(std::span<double> samples) const;

    // Engine: a 64-bit uniform random bit generator. The first samples are the same however many
    // are drawn.
    template <typename Engine>
    void draw(Engine& engine, std::span<double> samples) const {
        draw_normals(engine, samples);
        colour(samples);
    }

  private:
    using State = std::array<double, 4>;  // real and imaginary part of two pairs of poles
    // Of a sample: rms of what the samples before do not tell, and what it does to the state.
    struct Gain {
        double rms = 0;
        State state{};
    };

    std::array<double, 2> real_{}, imaginary_{};  // of exp(p dt)
    std::vector<Gain> gains_;  // of the first samples; the last one of all others
};

}  // namespace gearpod::signals
