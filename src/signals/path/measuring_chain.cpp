#include "signals/path/measuring_chain.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

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
    const double own = std::round(static_cast<double>(samples) * *sampling_Hz / applied_Hz);
    return std::clamp(static_cast<std::size_t>(own), std::size_t{1}, samples);
}

}  // namespace gearpod::signals
