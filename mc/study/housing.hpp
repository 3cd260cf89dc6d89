// Bearings of a planetary gearbox whose forces act on the housing, and the keys that state how the
// sensors respond to them.
#pragma once

#include <vector>

#include "mc/study/sensor.hpp"
#include "mc/study/study.hpp"

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

// True if the housing changes the vibration on its way to the sensors, by natural modes or a
// measured frequency response.
bool has_housing(const Study& study);

// Bearings whose forces reach a sensor: of the sun, of the carrier, of both or of none.
std::vector<HousingBearing> housing_bearings(const Study& study);

}  // namespace gearpod::mc
