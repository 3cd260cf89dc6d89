// Bearings of a planetary gearbox whose forces act on the housing, and the keys that state how the
// sensors respond to them.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "mc/study/sensor.hpp"
#include "mc/study/study.hpp"
#include "signals/path/frequency_response.hpp"

namespace gearpod::mc {

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

// Response of a study's sensors to the vibration that reaches them: of the housing, by natural
// modes or a measured frequency response, and of the measuring chain of an additional sensor.

// True if the housing changes the vibration on its way to the sensors.
bool has_housing(const Study& study);

// Measuring chain of an additional sensor, numbered from 1, that differs from the first one's.
// Empty for the first sensor, number 0.
std::optional<signals::MeasuringChain> measuring_chain(const Study& study, std::size_t sensor);

// True if a sensor, or any of them, has another response than 1.
bool has_response(const Study& study, std::size_t sensor);
bool any_response(const Study& study);

// Numbers of nodal diameters of the ring's modes, each once, ascending.
std::vector<int> ring_modes(const Study& study);

// Bearings whose forces reach a sensor: of the sun, of the carrier, of both or of none.
std::vector<HousingBearing> housing_bearings(const Study& study);

// Response to the first sensor for number 0, else to an additional one, with this factor on the
// natural frequencies: to the vibration that reaches the sensor, or to the load of the planets on
// the ring's modes with these nodal diameters. Contains the measuring chain.
signals::HousingResponse housing_response(const Study& study, std::size_t sensor,
                                          double frequency_factor);
signals::HousingResponse ring_response(const Study& study, std::size_t sensor, int nodal_diameters,
                                       double frequency_factor);
// The same to the acceleration of the shaft in one of these bearings.
signals::HousingResponse bearing_response(const Study& study, std::size_t sensor,
                                          const HousingBearing& bearing,
                                          const signals::BearingSupport& support,
                                          double frequency_factor);

}  // namespace gearpod::mc
