// Accelerometer noise of a study. Four independent parts add in quadrature: noise by its density,
// which the low-pass filters, the background of the machine by its spectrum, white noise by its
// rms, and the rounding of the converter.
#pragma once

#include <optional>
#include <string>

#include "mc/study/study.hpp"
#include "signals/noise/coloured_noise.hpp"

namespace gearpod::mc {

// True if a part is given by its density before the low-pass, nominal or random: the sensor's or
// the background's.
bool noise_by_density(const Study& study);
bool has_background(const Study& study);
// Spectrum of the background at level 1.
signals::NoiseSpectrum background_spectrum(const Study& study);

// True if the converter of any sensor has a measuring range, at which it clips the samples.
bool has_range(const Study& study);

// Standard deviation of every sample, m/s^2: of all parts, of those that are white, and of the
// background.
struct SensorNoise {
    double all_m_s2 = 0.0, white_m_s2 = 0.0, background_m_s2 = 0.0;
};
// Values of a gearbox that its noise depends on.
struct SensorNoiseInputs {
    std::optional<double> density_m_s2_per_sqrt_Hz;
    double rms_m_s2 = 0.0;
    double background_level = 1.0;
};
// Noise of a study apart from these values.
struct NoiseModel {
    double quantisation_m_s2 = 0.0;
    double low_pass_Hz = 0.0;
    // Of the background at level 1, after the low-pass; empty without one.
    std::optional<double> background_rms_m_s2;
};
NoiseModel noise_model(const Study& study);
// Noise of a gearbox with these values. Rounding to steps of q has the variance q^2 / 12 (W. R.
// Bennett, Bell Syst. Tech. J. 27 (1948), 446-472), if the signal spans several steps.
SensorNoise sensor_noise(const NoiseModel& model, const SensorNoiseInputs& inputs);
// Nominal standard deviation of every sample, m/s^2.
double sensor_noise_m_s2(const Study& study);

// Text of the nominal noise: the rms, and if several parts add in quadrature, each of them.
std::string noise_text(const Study& study);

// Key that gives the noise: that of the density, or without one "sensor.noise_m_s2".
const char* noise_key(const Study& study);

}  // namespace gearpod::mc
