// Sensor signal of a study: bearings whose forces reach it through the housing, its noise, and
// sources of vibration other than the gearbox.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mc/study/sensor.hpp"
#include "mc/study/study.hpp"
#include "signals/noise/coloured_noise.hpp"

namespace gearpod::mc {

// Bearing of a planetary gearbox whose force acts on the housing, and the keys that state how the
// sensors respond to it.
struct HousingBearing {
    Member shaft;
    double HousingMode::*per_kg;
    std::vector<double> Sensor::*gain;
    std::vector<double> Sensor::*phase_rad;
    std::vector<double> AdditionalSensor::*own_per_kg;
    std::vector<double> AdditionalSensor::*own_gain;
    std::vector<double> AdditionalSensor::*own_phase_deg;
    // Names of the keys: of a mode, and of sensors with a measured response.
    const char* per_kg_name;
    const char* gain_name;
    const char* phase_name;
};

inline constexpr HousingBearing kHousingBearings[] = {
    {Member::sun, &HousingMode::sun_bearing_per_kg, &Sensor::sun_response_gain,
     &Sensor::sun_response_phase_rad, &AdditionalSensor::sun_bearing_per_kg,
     &AdditionalSensor::sun_response_gain, &AdditionalSensor::sun_response_phase_deg,
     "sun_bearing_per_kg", "sun_response_gain", "sun_response_phase_deg"},
    {Member::carrier, &HousingMode::carrier_bearing_per_kg, &Sensor::carrier_response_gain,
     &Sensor::carrier_response_phase_rad, &AdditionalSensor::carrier_bearing_per_kg,
     &AdditionalSensor::carrier_response_gain, &AdditionalSensor::carrier_response_phase_deg,
     "carrier_bearing_per_kg", "carrier_response_gain", "carrier_response_phase_deg"}};

// True if the housing changes the vibration on its way to the sensors, by natural modes or a
// measured frequency response.
bool has_housing(const Study& study);

// Bearings whose forces reach a sensor: of the sun, of the carrier, of both or of none.
std::vector<HousingBearing> housing_bearings(const Study& study);

// Accelerometer noise. Four independent parts add in quadrature: noise by its density, which the
// low-pass filters, the background of the machine by its spectrum, white noise by its rms, and the
// rounding of the converter.

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
    // Background at level 1, after the low-pass; empty without one.
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

// Impulses per turn of the shaft if this part is faulty, from the bearing's geometry. With r =
// diameter_ratio cos(contact angle), and Z elements that roll without sliding: outer ring Z (1 - r)
// / 2, inner ring Z (1 + r) / 2, cage (1 - r) / 2, rolling element (1 - r^2) / diameter_ratio, as
// it meets both rings in every turn about its axis. T. A. Harris, Rolling Bearing Analysis.
double impulses_per_turn(const Bearing& bearing);
// Turns of the faulty part through the load zone per turn of the shaft; 0 for a constant load.
double load_turns_per_turn(const Bearing& bearing);

inline constexpr const char* kStagesKey = "sensor.stages";

// True if there are bearings or stages, which differ between the records of a gearbox.
bool has_other_sources(const Study& study);
// True if an elastic shaft couples a stage with the study's gearbox.
bool is_coupled(const Study& study);
// True if there are records of another fault than the study's.
bool has_other_fault(const Study& study);

// "outer ring of the sun's bearing"
std::string bearing_text(const Bearing& bearing);
// The other fault, "" without one: "a fault of the outer ring of a bearing of the sun"
std::string other_fault_text(const Study& study);

}  // namespace gearpod::mc
