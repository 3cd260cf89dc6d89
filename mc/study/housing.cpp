#include "mc/study/housing.hpp"

#include <algorithm>
#include <iterator>
#include <numbers>
#include <set>

namespace gearpod::mc {
namespace {

// Modes with these nodal diameters, or without any statement of them, at a sensor.
std::vector<signals::NaturalMode> modes_at(const Study& study, std::size_t sensor,
                                           std::optional<int> nodal_diameters, double factor) {
    const Sensor& s = study.sensor;
    std::vector<signals::NaturalMode> modes;
    for (std::size_t k = 0; k < s.housing_modes.size(); ++k) {
        const HousingMode& mode = s.housing_modes[k];
        if (mode.nodal_diameters == nodal_diameters) {
            const bool own = sensor > 0 && !s.additional[sensor - 1].participation.empty();
            modes.push_back({factor * mode.frequency_Hz, mode.damping,
                             own ? s.additional[sensor - 1].participation[k] : mode.participation});
        }
    }
    return modes;
}

// Measured response by gain and phase in units of `unit_rad`; 0 where no values are given.
signals::MeasuredResponse measured_response(const Sensor& sensor, const std::vector<double>& gain,
                                            const std::vector<double>& phase, double unit_rad) {
    signals::MeasuredResponse measured{sensor.response_Hz, {}};
    for (std::size_t i = 0; i < gain.size(); ++i) {
        measured.value.push_back(std::polar(gain[i], phase[i] * unit_rad));
    }
    measured.value.resize(sensor.response_Hz.size());
    return measured;
}

constexpr double kRadPerDegree = std::numbers::pi / 180.0;

// True if the force in a bearing reaches one of the sensors.
bool acts(const Sensor& s, const HousingBearing& bearing) {
    const auto nonzero = [](double value) { return value != 0.0; };
    return std::ranges::any_of(s.housing_modes, nonzero, bearing.per_kg) ||
           std::ranges::any_of(s.*bearing.gain, nonzero) ||
           std::ranges::any_of(s.additional, [&](const AdditionalSensor& own) {
               return std::ranges::any_of(own.*bearing.own_per_kg, nonzero) ||
                      std::ranges::any_of(own.*bearing.own_gain, nonzero);
           });
}

}  // namespace

bool has_housing(const Study& study) {
    return !study.sensor.housing_modes.empty() || !study.sensor.response_Hz.empty();
}

std::optional<signals::MeasuringChain> measuring_chain(const Study& study, std::size_t sensor) {
    if (sensor == 0) {
        return std::nullopt;
    }
    const AdditionalSensor& own = study.sensor.additional[sensor - 1];
    signals::MeasuringChain chain{{}, {}, own.delay_s, own.sampling_Hz};
    if (own.low_pass_Hz) {
        chain.low_pass = {*own.low_pass_Hz, study.sensor.low_pass_Hz};
    }
    if (own.mounting_Hz) {
        chain.mounting = {*own.mounting_Hz, own.mounting_damping};
    }
    const bool differs =
        chain.low_pass || chain.mounting || chain.delay_s != 0.0 || chain.sampling_Hz;
    return differs ? std::optional(chain) : std::nullopt;
}

bool has_response(const Study& study, std::size_t sensor) {
    return has_housing(study) || measuring_chain(study, sensor);
}

bool any_response(const Study& study) {
    for (std::size_t sensor = 0; sensor <= study.sensor.additional.size(); ++sensor) {
        if (has_response(study, sensor)) {
            return true;
        }
    }
    return false;
}

std::vector<int> ring_modes(const Study& study) {
    std::set<int> numbers;
    for (const HousingMode& mode : study.sensor.housing_modes) {
        if (mode.nodal_diameters) {
            numbers.insert(*mode.nodal_diameters);
        }
    }
    return {numbers.begin(), numbers.end()};
}

signals::HousingResponse housing_response(const Study& study, std::size_t sensor,
                                          double frequency_factor) {
    const Sensor& s = study.sensor;
    signals::HousingResponse response;
    response.modes = modes_at(study, sensor, std::nullopt, frequency_factor);
    response.chain = measuring_chain(study, sensor);
    if (s.response_Hz.empty()) {
        return response;
    }
    const bool own = sensor > 0 && !s.additional[sensor - 1].response_gain.empty();
    response.measured =
        own ? measured_response(s, s.additional[sensor - 1].response_gain,
                                s.additional[sensor - 1].response_phase_deg, kRadPerDegree)
            : measured_response(s, s.response_gain, s.response_phase_rad, 1.0);
    return response;
}

signals::HousingResponse ring_response(const Study& study, std::size_t sensor, int nodal_diameters,
                                       double frequency_factor) {
    return {.stiff_path = false,
            .modes = modes_at(study, sensor, nodal_diameters, frequency_factor),
            .measured = {},
            .chain = measuring_chain(study, sensor)};
}

std::vector<HousingBearing> housing_bearings(const Study& study) {
    std::vector<HousingBearing> bearings;
    std::ranges::copy_if(
        kHousingBearings, std::back_inserter(bearings),
        [&](const HousingBearing& bearing) { return acts(study.sensor, bearing); });
    return bearings;
}

signals::HousingResponse bearing_response(const Study& study, std::size_t sensor,
                                          const HousingBearing& bearing,
                                          const signals::BearingSupport& support,
                                          double frequency_factor) {
    const Sensor& s = study.sensor;
    const AdditionalSensor* const own = sensor > 0 ? &s.additional[sensor - 1] : nullptr;
    signals::HousingResponse response{.stiff_path = false,
                                      .modes = {},
                                      .measured = {},
                                      .chain = measuring_chain(study, sensor),
                                      .bearing = support};
    if (!s.response_Hz.empty()) {
        response.measured = own != nullptr && !(own->*bearing.own_gain).empty()
                                ? measured_response(s, own->*bearing.own_gain,
                                                    own->*bearing.own_phase_deg, kRadPerDegree)
                                : measured_response(s, s.*bearing.gain, s.*bearing.phase_rad, 1.0);
        return response;
    }
    const bool has_own = own != nullptr && !(own->*bearing.own_per_kg).empty();
    for (std::size_t k = 0; k < s.housing_modes.size(); ++k) {
        const HousingMode& mode = s.housing_modes[k];
        response.modes.push_back({frequency_factor * mode.frequency_Hz, mode.damping,
                                  has_own ? (own->*bearing.own_per_kg)[k] : mode.*bearing.per_kg});
    }
    return response;
}

}  // namespace gearpod::mc
