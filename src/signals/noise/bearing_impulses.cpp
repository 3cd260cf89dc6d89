#include "signals/noise/bearing_impulses.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace gearpod::signals {

using std::numbers::pi;
using Complex = std::complex<double>;

double bearing_load(double load_zone_rad, double turns) {
    if (load_zone_rad == 0.0) {
        return 1.0;
    }
    const double edge = std::cos(0.5 * load_zone_rad),
                 height = std::cos(2.0 * pi * (turns - std::rint(turns))) - edge;
    return height > 0.0 ? std::pow(height / (1.0 - edge), 1.5) : 0.0;
}

// The response is the sum of 2 Re(r_k exp(p_k t)) over the poles p_k in the upper half plane, with
// the residues r_k of the product of both transfer functions. Frequencies are relative to the
// low-pass.
ResonanceResponse::ResonanceResponse(const BearingImpulses& bearing, double low_pass_Hz,
                                     double sample_s) {
    const double relative = bearing.resonance_Hz / low_pass_Hz;
    const bool frequencies = bearing.resonance_Hz > 0.0 && low_pass_Hz > 0.0 && sample_s > 0.0 &&
                             bearing.rate_Hz > 0.0 && std::isfinite(relative) &&
                             std::isfinite(low_pass_Hz * sample_s);
    if (!frequencies || !(bearing.damping > 0.0) || bearing.damping > kMostResonanceDamping) {
        throw std::invalid_argument("bearing: invalid frequency or damping ratio");
    }
    const double damped = relative * std::sqrt(1.0 - bearing.damping * bearing.damping);
    pole_ = {Complex(-bearing.damping * relative, damped), std::polar(1.0, 0.625 * pi),
             std::polar(1.0, 0.875 * pi)};
    for (std::size_t k = 0; k < pole_.size(); ++k) {
        Complex product = 2.0 * Complex(0.0, pole_[k].imag());
        for (std::size_t j = 0; j < pole_.size(); ++j) {
            if (j != k) {
                product *= (pole_[k] - pole_[j]) * (pole_[k] - std::conj(pole_[j]));
            }
        }
        weight_[k] = 2.0 * bearing.amplitude_m_s2 * damped / product;
    }
    constexpr double kDecayed = 20.7;  // -log 1e-9
    double slowest = -pole_[0].real();
    for (std::size_t k = 0; k < pole_.size(); ++k) {
        slowest = std::min(slowest, -pole_[k].real());
        pole_[k] *= 2.0 * pi * low_pass_Hz;
        decay_[k] = std::exp(pole_[k] * sample_s);
    }
    decay_s_ = kDecayed / (2.0 * pi * low_pass_Hz * slowest);
}

void ResonanceResponse::excite(double size, double before_s) {
    for (std::size_t k = 0; k < pole_.size(); ++k) {
        state_[k] += size * weight_[k] * std::exp(pole_[k] * before_s);
    }
}

void ResonanceResponse::advance() {
    for (std::size_t k = 0; k < pole_.size(); ++k) {
        const double real = state_[k].real(), imaginary = state_[k].imag();
        state_[k] = {decay_[k].real() * real - decay_[k].imag() * imaginary,
                     decay_[k].imag() * real + decay_[k].real() * imaginary};
    }
}

double ResonanceResponse::energy() const {
    double sum = 0.0;
    for (std::size_t k = 0; k < pole_.size(); ++k) {
        for (std::size_t j = 0; j < pole_.size(); ++j) {
            sum -= 0.5 * (weight_[k] * weight_[j] / (pole_[k] + pole_[j]) +
                          weight_[k] * std::conj(weight_[j]) / (pole_[k] + std::conj(pole_[j])))
                             .real();
        }
    }
    return sum;
}

double bearing_rms(const BearingImpulses& bearing, double low_pass_Hz) {
    return std::sqrt(bearing.rate_Hz *
                     ResonanceResponse(bearing, low_pass_Hz, 1.0 / low_pass_Hz).energy());
}

}  // namespace gearpod::signals
