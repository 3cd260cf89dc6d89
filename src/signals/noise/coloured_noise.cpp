#include "signals/noise/coloured_noise.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>

#include "signals/spectra/fourier_transform.hpp"

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

using Complex = std::complex<double>;
using Direction = FourierTransform::Direction;
constexpr auto kCount = static_cast<std::size_t>(ShapedNoise::kTaps);

// The low-pass passes 1e-16 of the power there, and nothing above is counted.
constexpr double kMostPassed = 100.0;

// |H|^2 of the low-pass.
double passed(double frequency_Hz, double low_pass_Hz) {
    return 1.0 / (1.0 + std::pow(frequency_Hz / low_pass_Hz, 8.0));
}

bool valid(const NoiseSpectrum& spectrum) {
    const auto above_0 = [](double value) { return value > 0.0 && std::isfinite(value); };
    const std::vector<double>& f = spectrum.frequency_Hz;
    return f.size() >= 2 && f.size() == spectrum.density_m_s2_per_sqrt_Hz.size() &&
           std::ranges::all_of(f, above_0) &&
           std::ranges::all_of(spectrum.density_m_s2_per_sqrt_Hz, above_0) &&
           std::ranges::adjacent_find(f, std::greater_equal<>()) == f.end();
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

double NoiseSpectrum::at(double f) const {
    if (!(f >= frequency_Hz.front() && f <= frequency_Hz.back())) {
        return 0.0;
    }
    const auto above = std::ranges::upper_bound(frequency_Hz, f);
    const auto i =
        std::min(static_cast<std::size_t>(above - frequency_Hz.begin()), frequency_Hz.size() - 1);
    const double part =
        std::log(f / frequency_Hz[i - 1]) / std::log(frequency_Hz[i] / frequency_Hz[i - 1]);
    return density_m_s2_per_sqrt_Hz[i - 1] *
           std::pow(density_m_s2_per_sqrt_Hz[i] / density_m_s2_per_sqrt_Hz[i - 1], part);
}

double NoiseSpectrum::rms_m_s2(double low_pass_Hz) const {
    // Simpson's rule over the logarithm of the frequency.
    constexpr int kIntervals = 400;
    double sum = 0.0;
    for (std::size_t i = 1; i < frequency_Hz.size(); ++i) {
        const double width = std::log(frequency_Hz[i] / frequency_Hz[i - 1]) / kIntervals;
        for (int k = 0; k <= kIntervals; ++k) {
            const double f =
                k == kIntervals ? frequency_Hz[i] : frequency_Hz[i - 1] * std::exp(width * k);
            const double weight = k == 0 || k == kIntervals ? 1.0 : k % 2 == 1 ? 4.0 : 2.0;
            const double density = at(f);
            sum += weight * width / 3.0 * f * density * density * passed(f, low_pass_Hz);
        }
    }
    return std::sqrt(sum);
}

ShapedNoise::ShapedNoise(const NoiseSpectrum& spectrum, double low_pass_Hz, double sampling_Hz) {
    const bool frequencies = low_pass_Hz > 0.0 && std::isfinite(low_pass_Hz) && sampling_Hz > 0.0 &&
                             std::isfinite(sampling_Hz);
    if (!valid(spectrum) || !frequencies) {
        throw std::invalid_argument("shaped noise: invalid spectrum or frequencies");
    }
    std::vector<Complex> root(kCount), taps(kCount);
    for (std::size_t k = 0; k <= kCount / 2; ++k) {
        const double f = static_cast<double>(k) / static_cast<double>(kCount) * sampling_Hz;
        double sum = 0.0;
        const auto add = [&](double aliased_Hz) {
            const double density = spectrum.at(aliased_Hz);
            sum += density * density * passed(aliased_Hz, low_pass_Hz);
        };
        add(f);
        const double last = std::min(spectrum.frequency_Hz.back(), kMostPassed * low_pass_Hz);
        for (double turn = sampling_Hz; turn - f <= last; turn += sampling_Hz) {
            add(turn - f);
            add(turn + f);
        }
        root[k] = std::sqrt(sum);
        root[(kCount - k) % kCount] = root[k];
    }
    FourierTransform back(kTaps, Direction::back);
    back.transform(root, taps);
    // The filter's centre is at half its length.
    std::vector<Complex> padded(2 * kCount);
    double square = 0.0;
    for (std::size_t j = 0; j < kCount; ++j) {
        const double hann =
            0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * static_cast<double>(j) / kTaps);
        padded[j] = hann * taps[(j + kCount / 2) % kCount].real();
        square += std::norm(padded[j]);
    }
    if (!(square > 0.0)) {
        throw std::invalid_argument("shaped noise: the spectrum does not pass the low-pass");
    }
    response_.resize(2 * kCount);
    FourierTransform forward(2 * kTaps);
    forward.transform(padded, response_);
    // Variance 1, and the factor of the inverse transform in filter().
    const double scale = 1.0 / std::sqrt(square) / (2.0 * kTaps);
    for (Complex& value : response_) {
        value *= scale;
    }
}

// The filter is real: two blocks are filtered together as real and imaginary parts.
void ShapedNoise::filter(std::span<const double> normals, std::span<double> samples) const {
    FourierTransform forward(2 * kTaps), back(2 * kTaps, Direction::back);
    std::vector<Complex> block(2 * kCount), spectrum(2 * kCount);
    const auto convolve = [&](const double* real, const double* imaginary) {
        std::ranges::fill(block, 0.0);
        for (std::size_t i = 0; i < kCount; ++i) {
            block[i] = {real[i], imaginary == nullptr ? 0.0 : imaginary[i]};
        }
        forward.transform(block, spectrum);
        for (std::size_t k = 0; k < spectrum.size(); ++k) {
            const Complex a = spectrum[k], b = response_[k];
            spectrum[k] = {a.real() * b.real() - a.imag() * b.imag(),
                           a.real() * b.imag() + a.imag() * b.real()};
        }
        back.transform(spectrum, block);
    };
    std::vector<double> tail(kCount);
    // The first block only prepares the filter.
    convolve(normals.data(), nullptr);
    for (std::size_t i = 0; i < kCount; ++i) {
        tail[i] = block[kCount + i].real();
    }
    for (std::size_t first = 0; first < samples.size(); first += 2 * kCount) {
        convolve(normals.data() + kCount + first, normals.data() + 2 * kCount + first);
        const std::size_t rest = samples.size() - first;
        for (std::size_t i = 0; i < std::min(kCount, rest); ++i) {
            samples[first + i] = block[i].real() + tail[i];
        }
        for (std::size_t i = kCount; i < std::min(2 * kCount, rest); ++i) {
            samples[first + i] = block[i - kCount].imag() + block[i].real();
        }
        for (std::size_t i = 0; i < kCount; ++i) {
            tail[i] = block[kCount + i].imag();
        }
    }
}

}  // namespace gearpod::signals
