#include "mc/study/housing.hpp"

#include <algorithm>
#include <iterator>

namespace gearpod::mc {
namespace {

// True if the force in a bearing reaches one of the sensors.
bool acts(const Sensor& s, const HousingBearing& bearing) {
    const auto nonzero = [](double value) { return value != 0.0; };
    return std::ranges::any_of(s.housing_modes, nonzero, bearing.per_kg) ||
           std::ranges::any_of(s.*bearing.gain, nonzero) ||
           std::ranges::any_of(s.additional, [&](const AdditionalSensor& additional) {
               return std::ranges::any_of(additional.*bearing.own_per_kg, nonzero) ||
                      std::ranges::any_of(additional.*bearing.own_gain, nonzero);
           });
}

}  // namespace

bool has_housing(const Study& study) {
    return !study.sensor.housing_modes.empty() || !study.sensor.response_Hz.empty();
}

std::vector<HousingBearing> housing_bearings(const Study& study) {
    std::vector<HousingBearing> bearings;
    std::ranges::copy_if(
        kHousingBearings, std::back_inserter(bearings),
        [&](const HousingBearing& bearing) { return acts(study.sensor, bearing); });
    return bearings;
}

}  // namespace gearpod::mc
