// Measuring chain of an accelerometer: mounting, low-pass, clock and sampling rate, applied to
// samples that have already passed another low-pass. All but the rate are a factor on the spectrum:
//
//     E(f) = B(f / f_c) / B(f / f_a) M(f) exp(-2 pi i f tau),
//     B(r) = 1 / ((1 - r^2 + 2 i cos(pi/8) r) (1 - r^2 + 2 i cos(3 pi/8) r)),
//     M(f) = (1 + 2 i zeta r) / (1 - r^2 + 2 i zeta r),    r = f / f_m,
//
// with the Butterworth low-pass B of order 4, its cut-off frequency f_c, that of the low-pass that
// was applied, f_a, and the delay tau. M is the transmissibility of a mounting of natural frequency
// f_m and damping ratio zeta (S. S. Rao, Mechanical Vibrations). A converter with a lower sampling
// rate then takes its own samples, which PeriodicResponse (housing_response.hpp) interpolates.
#pragma once

#include <complex>
#include <cstddef>
#include <optional>

namespace gearpod::signals {

struct MeasuringChain {
    struct LowPass {
        double own_Hz = 0.0, applied_Hz = 0.0;
    };
    struct Mounting {
        double frequency_Hz = 0.0, damping = 0.0;
    };

    std::optional<LowPass> low_pass;
    std::optional<Mounting> mounting;
    double delay_s = 0.0;  // positive: samples are late
    std::optional<double> sampling_Hz = {};

    // E at f Hz.
    std::complex<double> at(double f_Hz) const;
    // Number of samples that the converter takes during `samples` samples at applied_Hz, rounded to
    // a whole number; `samples` if it has no lower rate.
    std::size_t own_samples(std::size_t samples, double applied_Hz) const;
};

}  // namespace gearpod::signals
