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
// rate then takes its own samples, which PeriodicResponse interpolates.
#pragma once

#include <complex>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "signals/spectra/fourier_transform.hpp"

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

// Response of the housing: what a sensor measures per unit of the acceleration that reaches it
// along a stiff path.
//
// Natural modes of the housing add to that acceleration as for a structure whose base is moved (R.
// W. Clough and J. Penzien, Dynamics of Structures):
//
//     H(f) = 1 + sum over the modes of phi r^2 / (1 - r^2 + 2 i zeta r),    r = f / f_k,
//
// with natural frequency f_k, damping ratio zeta and participation phi at the sensor. Slow
// vibration is unchanged. At its natural frequency a mode adds phi / (2 zeta). One mode with phi =
// 1 is a sensor on a resonant mounting. A measured frequency response is an alternative to modes.
// The sensor's measuring chain, if it has one of its own, multiplies H.
//
// A bearing puts the force F = k u + c u' on the housing, with the displacement u of its shaft
// along the direction of the sensor, F = -(k + i w c) / w^2 times the acceleration of the shaft, w
// = 2 pi f. The modal equations give the sensor's acceleration per force, the accelerance (D. J.
// Ewins, Modal Testing)
//
//     A(f) = -sum over the modes of R r^2 / (1 - r^2 + 2 i zeta r),
//
// with R the product of the mode shape at the bearing and at the sensor over the modal mass, 1/kg.
// The response to the acceleration of the shaft is H(f) = -A(f) (k + i w c) / w^2, and 0 at f = 0.
struct NaturalMode {
    double frequency_Hz = 0.0, damping = 0.0;
    double participation = 0.0;  // phi; R for a bearing
};

// Measured H: complex values between the given frequencies are interpolated linearly, and H is 0
// outside of them.
struct MeasuredResponse {
    std::vector<double> frequency_Hz;  // ascending, not negative
    std::vector<std::complex<double>> value;

    std::complex<double> at(double f_Hz) const;
};

// Bearing in the housing.
struct BearingSupport {
    double stiffness_N_m = 0.0, damping_N_s_m = 0.0;  // k and c

    // F at f Hz per acceleration of the shaft, kg.
    std::complex<double> force_per_acceleration(double f_Hz) const;
};

struct HousingResponse {
    bool stiff_path = true;  // the 1 in H
    std::vector<NaturalMode> modes;
    std::optional<MeasuredResponse> measured;  // in place of the above
    std::optional<MeasuringChain> chain = {};  // factor on the above
    // Bearing whose shaft's acceleration is the input. The modes, without stiff path, or the
    // measured values are then the accelerance.
    std::optional<BearingSupport> bearing = {};

    // H at f Hz.
    std::complex<double> at(double f_Hz) const;
};

// Steady response to periodic signals of a given number of samples, exact at their harmonics.
// Harmonics above half the sampling rate, which the sensor's low-pass leaves small, respond at
// their alias frequency. Holds scratch memory: use one object per thread.
//
// The samples are transformed as complex numbers, two in one (J. W. Cooley, P. A. W. Lewis and P.
// D. Welch, J. Sound Vib. 12 (1970), 315-337). An odd number of samples is taken twice.
class PeriodicResponse {
  public:
    explicit PeriodicResponse(int samples);

    // Adds the response to a signal of this sampling rate. Throws std::invalid_argument if it has
    // another length.
    void add(std::span<const double> signal, double sampling_Hz, const HousingResponse& response);
    // Returns the sum of the responses since the last call, as the converter of a measuring chain
    // samples it. A lower rate of its own takes equally spaced samples, the first one with the
    // first sample of the signal. They are interpolated without frequencies above half that rate;
    // frequencies of the sum above it are aliased.
    std::vector<double> take(const std::optional<MeasuringChain>& chain = {},
                             double sampling_Hz = 0.0);

  private:
    // Replaces the sum by the aliased spectrum of `own` samples of it.
    void alias(std::size_t input_samples);
    std::size_t half() const { return values_.size(); }

    std::size_t samples_;
    FourierTransform forward_, back_;
    std::vector<std::complex<double>> values_, spectrum_;  // half as many as samples
    std::vector<std::complex<double>> turn_, sum_;         // from 0 to half the sampling rate
};

}  // namespace gearpod::signals
