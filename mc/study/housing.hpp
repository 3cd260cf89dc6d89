// Response of a study's sensors to the vibration that reaches them: of the housing, by natural
// modes or a measured frequency response, and of the measuring chain of an additional sensor.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "mc/study/housing_bearings.hpp"
#include "mc/study/study.hpp"
#include "signals/path/housing_response.hpp"

namespace gearpod::mc {

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
