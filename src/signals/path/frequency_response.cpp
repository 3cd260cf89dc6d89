#include "signals/path/frequency_response.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace gearpod::signals {
namespace {

using std::numbers::pi;
using Complex = std::complex<double>;

// 1 / B at r times the cut-off frequency.
Complex inverse_low_pass(double r) {
    static const double first = 2.0 * std::cos(pi / 8.0), second = 2.0 * std::cos(3.0 * pi / 8.0);
    const double real = 1.0 - r * r;
    return Complex(real, first * r) * Complex(real, second * r);
}

// Values of the modes or the measured ones.
Complex of_housing(const HousingResponse& response, double f_Hz) {
    if (response.measured) {
        return response.measured->at(f_Hz);
    }
    double real = response.stiff_path ? 1.0 : 0.0, imaginary = 0.0;
    for (const NaturalMode& mode : response.modes) {
        const double r = f_Hz / mode.frequency_Hz;
        const double a = 1.0 - r * r, b = 2.0 * mode.damping * r;
        const double share = mode.participation * r * r / (a * a + b * b);
        real += share * a;
        imaginary -= share * b;
    }
    return {real, imaginary};
}

int half_of(int samples) {
    return samples % 2 == 0 ? samples / 2 : samples;
}

Complex product(Complex a, Complex b) {
    return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

}  // namespace

Complex MeasuringChain::at(double f_Hz) const {
    Complex factor = std::polar(1.0, -2.0 * pi * f_Hz * delay_s);
    if (low_pass) {
        factor *= inverse_low_pass(f_Hz / low_pass->applied_Hz) /
                  inverse_low_pass(f_Hz / low_pass->own_Hz);
    }
    if (mounting) {
        const double r = f_Hz / mounting->frequency_Hz, damping = 2.0 * mounting->damping * r;
        factor *= Complex(1.0, damping) / Complex(1.0 - r * r, damping);
    }
    return factor;
}

std::size_t MeasuringChain::own_samples(std::size_t samples, double applied_Hz) const {
    if (!sampling_Hz) {
        return samples;
    }
    const double input_samples =
        std::round(static_cast<double>(samples) * *sampling_Hz / applied_Hz);
    return std::clamp(static_cast<std::size_t>(input_samples), std::size_t{1}, samples);
}

using Complex = std::complex<double>;

Complex HousingResponse::at(double f_Hz) const {
    Complex housing = of_housing(*this, f_Hz);
    if (bearing) {
        // The modes' sum is -A.
        housing *= (measured ? 1.0 : -1.0) * bearing->force_per_acceleration(f_Hz);
    }
    return chain ? housing * chain->at(f_Hz) : housing;
}

Complex BearingSupport::force_per_acceleration(double f_Hz) const {
    const double w = 2.0 * std::numbers::pi * f_Hz;
    return f_Hz == 0.0 ? 0.0 : -Complex(stiffness_N_m, w * damping_N_s_m) / (w * w);
}

Complex MeasuredResponse::at(double f_Hz) const {
    if (!(f_Hz >= frequency_Hz.front() && f_Hz <= frequency_Hz.back())) {
        return 0.0;
    }
    const auto above = std::ranges::upper_bound(frequency_Hz, f_Hz);
    const auto i =
        std::min(static_cast<std::size_t>(above - frequency_Hz.begin()), frequency_Hz.size() - 1);
    if (i == 0) {
        return value[0];  // a single frequency
    }
    const double part = (f_Hz - frequency_Hz[i - 1]) / (frequency_Hz[i] - frequency_Hz[i - 1]);
    return (1.0 - part) * value[i - 1] + part * value[i];
}

PeriodicResponse::PeriodicResponse(int samples)
    : samples_(static_cast<std::size_t>(samples)),
      forward_(half_of(samples)),
      back_(half_of(samples), FourierTransform::Direction::back),
      values_(static_cast<std::size_t>(half_of(samples))),
      spectrum_(values_.size()),
      sum_(values_.size() + 1) {
    for (std::size_t k = 0; k <= half(); ++k) {
        turn_.push_back(std::polar(
            1.0, -std::numbers::pi * static_cast<double>(k) / static_cast<double>(half())));
    }
}

void PeriodicResponse::add(std::span<const double> signal, double sampling_Hz,
                           const HousingResponse& response) {
    if (signal.size() != samples_) {
        throw std::invalid_argument("periodic response: the signal has another length");
    }
    for (std::size_t i = 0; i < half(); ++i) {
        values_[i] = {signal[2 * i % samples_], signal[(2 * i + 1) % samples_]};
    }
    forward_.transform(values_, spectrum_);
    const double step_Hz = sampling_Hz / static_cast<double>(2 * half());
    for (std::size_t k = 0; k <= half(); ++k) {
        const Complex a = spectrum_[k % half()], b = std::conj(spectrum_[(half() - k) % half()]);
        const Complex odd = product(turn_[k], Complex(0.0, -0.5) * (a - b));
        const Complex y =
            product(0.5 * (a + b) + odd, response.at(step_Hz * static_cast<double>(k)));
        sum_[k] += k == 0 || k == half() ? Complex(y.real()) : y;
    }
}

// Harmonic k of n samples has the same values at `own` of them as harmonic k modulo `own`. Both
// signs of k contribute to a one-sided sum: at 0 and at half the rate their imaginary parts cancel.
void PeriodicResponse::alias(std::size_t input_samples) {
    const std::size_t count = input_samples * (2 * half() / samples_);
    for (std::size_t k = count / 2 + (count % 2 == 0 ? 0 : 1); k <= half(); ++k) {
        // Half the sampling rate occurs once, half of it with each sign.
        const Complex value = k == half() ? 0.5 * sum_[k] : sum_[k];
        sum_[k] = 0.0;
        const std::size_t rest = k % count;
        if (rest == 0) {
            sum_[0] += 2.0 * value.real();
        } else if (2 * rest == count) {
            sum_[rest] += value.real();
        } else if (2 * rest < count) {
            sum_[rest] += value;
        } else {
            sum_[count - rest] += std::conj(value);
        }
    }
}

std::vector<double> PeriodicResponse::take(const std::optional<MeasuringChain>& chain,
                                           double sampling_Hz) {
    const std::size_t input_samples = chain ? chain->own_samples(samples_, sampling_Hz) : samples_;
    if (input_samples < samples_) {
        alias(input_samples);
    }
    for (std::size_t k = 0; k < half(); ++k) {
        const Complex a = sum_[k], b = std::conj(sum_[half() - k]);
        spectrum_[k] = a + b + Complex(0.0, 1.0) * product(std::conj(turn_[k]), a - b);
    }
    back_.transform(spectrum_, values_);
    std::vector<double> out(samples_);
    const double scale = 0.5 / static_cast<double>(half());
    for (std::size_t i = 0; i < samples_; ++i) {
        out[i] = scale * (i % 2 == 0 ? values_[i / 2].real() : values_[i / 2].imag());
    }
    std::ranges::fill(sum_, 0.0);
    return out;
}

}  // namespace gearpod::signals
