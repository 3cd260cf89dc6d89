#include "signals/noise/low_pass_noise.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <stdexcept>

namespace gearpod::signals {
namespace {

using std::numbers::pi;
using Complex = std::complex<double>;

// Number of samples with gains of their own. The error of the gains shrinks by a factor of 0.3 or
// less per sample, so 48 samples converge to rounding. That is twice the rate of the largest zero
// of sampled smooth noise (Astrom, Hagander, Sternby 1984).
constexpr int kTransient = 48;

// Poles of the filter in the upper half plane, two of the four, normalised to the unit circle.
std::array<Complex, 2> poles() {
    return {std::polar(1.0, 0.625 * pi), std::polar(1.0, 0.875 * pi)};
}

// Weights c_k over the variance, where the autocovariance is the sum of 2 Re(c_k exp(p_k w_c tau)).
// From the residues r of H: c_k = -r_k sum over all poles j of r_j / (p_k + p_j).
std::array<Complex, 2> covariance_weights() {
    const auto upper = poles();
    const std::array<Complex, 4> all{upper[0], upper[1], std::conj(upper[0]), std::conj(upper[1])};
    std::array<Complex, 4> residue;
    for (std::size_t k = 0; k < 4; ++k) {
        Complex product = 1.0;
        for (std::size_t j = 0; j < 4; ++j) {
            product *= j == k ? Complex(1.0) : all[k] - all[j];
        }
        residue[k] = 1.0 / product;
    }
    std::array<Complex, 2> weight;
    for (std::size_t k = 0; k < 2; ++k) {
        Complex sum = 0.0;
        for (std::size_t j = 0; j < 4; ++j) {
            sum += residue[j] / (all[k] + all[j]);
        }
        weight[k] = -residue[k] * sum;
    }
    const double variance = 2.0 * (weight[0] + weight[1]).real();
    return {weight[0] / variance, weight[1] / variance};
}

}  // namespace

double low_pass_noise_bandwidth_Hz(double low_pass_Hz) {
    return low_pass_Hz * (pi / 8.0) / std::sin(pi / 8.0);
}

LowPassNoise::LowPassNoise(double low_pass_per_sample) {
    if (!(low_pass_per_sample > 0.25 * kLeast) || !std::isfinite(low_pass_per_sample)) {
        throw std::invalid_argument("low-pass noise: sampled too finely for its low-pass");
    }
    const auto pole = poles(), weight = covariance_weights();
    State covariance{};  // covariance of the next state with this sample
    for (std::size_t k = 0; k < 2; ++k) {
        const Complex decay = std::exp(2.0 * pi * low_pass_per_sample * pole[k]);
        real_[k] = decay.real();
        imaginary_[k] = decay.imag();
        covariance[2 * k] = (2.0 * weight[k] * decay).real();
        covariance[2 * k + 1] = (2.0 * weight[k] * decay).imag();
    }
    const auto turned = [&](const State& x) {
        State next;
        for (std::size_t k = 0; k < 2; ++k) {
            next[2 * k] = real_[k] * x[2 * k] - imaginary_[k] * x[2 * k + 1];
            next[2 * k + 1] = imaginary_[k] * x[2 * k] + real_[k] * x[2 * k + 1];
        }
        return next;
    };
    std::array<State, 4> known{};  // covariance of the predicted state, symmetric
    for (int sample = 0; sample < kTransient; ++sample) {
        State of_sample;  // covariance of the prediction with the predicted sample
        for (std::size_t i = 0; i < 4; ++i) {
            of_sample[i] = known[i][0] + known[i][2];
        }
        const double unknown = 1.0 - (of_sample[0] + of_sample[2]);
        const State turned_sample = turned(of_sample);
        Gain gain{std::sqrt(unknown), {}};
        for (std::size_t i = 0; i < 4; ++i) {
            gain.state[i] = (covariance[i] - turned_sample[i]) / unknown;
        }
        gains_.push_back(gain);
        std::array<State, 4> half, next;  // rotated on one side, then on both
        for (std::size_t i = 0; i < 4; ++i) {
            half[i] = turned(known[i]);
        }
        for (std::size_t i = 0; i < 4; ++i) {
            next[i] = turned({half[0][i], half[1][i], half[2][i], half[3][i]});
        }
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = 0; j < 4; ++j) {
                known[i][j] =
                    0.5 * (next[i][j] + next[j][i]) + gain.state[i] * gain.state[j] * unknown;
            }
        }
    }
}

void LowPassNoise::colour(std::span<double> samples) const {
    State x{};
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const Gain& gain = gains_[std::min(i, gains_.size() - 1)];
        const double new_part = gain.rms * samples[i];
        samples[i] = x[0] + x[2] + new_part;
        x = {real_[0] * x[0] - imaginary_[0] * x[1] + gain.state[0] * new_part,
             imaginary_[0] * x[0] + real_[0] * x[1] + gain.state[1] * new_part,
             real_[1] * x[2] - imaginary_[1] * x[3] + gain.state[2] * new_part,
             imaginary_[1] * x[2] + real_[1] * x[3] + gain.state[3] * new_part};
    }
}

}  // namespace gearpod::signals
