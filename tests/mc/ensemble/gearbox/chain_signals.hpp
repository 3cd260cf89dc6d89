// Signals of the small study's sensors with a measuring chain of their own.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include "tests/mc/ensemble/gearbox/small_runs.hpp"

namespace gearpod::test {

inline constexpr double kLowPass_Hz = 120.0;  // of the small study
// Noise bandwidth of the low-pass over its cut-off frequency.
inline const double kBandwidth = (std::numbers::pi / 8.0) / std::sin(std::numbers::pi / 8.0);

// Sensors next to the first one, so that they differ by their measuring chain alone.
inline std::string side(const std::string& fields) {
    return " --set 'sensor.additional=[{name=\"side\", angle_deg=0, " + fields + "}]' ";
}

// Component of a signal at a harmonic of its length.
inline std::complex<double> component(const std::vector<double>& signal, std::size_t harmonic) {
    std::complex<double> sum = 0.0;
    for (std::size_t i = 0; i < signal.size(); ++i) {
        const std::size_t turns = harmonic * i % signal.size();
        sum += signal[i] * std::polar(1.0, -2.0 * std::numbers::pi * static_cast<double>(turns) /
                                               static_cast<double>(signal.size()));
    }
    return sum / static_cast<double>(signal.size());
}

// Rms of the noise in a column.
inline double noise_rms(const Columns& columns, const std::string& sensor) {
    const std::vector<double>&clean = columns.at(sensor), &noisy = columns.at(sensor + "_noise_1");
    double sum = 0.0;
    for (std::size_t i = 0; i < clean.size(); ++i) {
        sum += (noisy[i] - clean[i]) * (noisy[i] - clean[i]);
    }
    return std::sqrt(sum / static_cast<double>(clean.size()));
}

// The sensor does not measure the gearbox.
inline const std::string kSilent =
    " --set 'sensor.response_Hz=[0, 1000]' --set 'sensor.response_phase_deg=[0, 0]'"
    " --set 'sensor.response_gain=[0, 0]' ";

}  // namespace gearpod::test
