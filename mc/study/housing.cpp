#include "mc/study/housing.hpp"

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
    signals::MeasuredResponse measured{s.response_Hz, {}};
    for (std::size_t i = 0; i < s.response_Hz.size(); ++i) {
        measured.value.push_back(own ? std::polar(s.additional[sensor - 1].response_gain[i],
                                                  s.additional[sensor - 1].response_phase_deg[i] *
                                                      std::numbers::pi / 180.0)
                                     : std::polar(s.response_gain[i], s.response_phase_rad[i]));
    }
    response.measured = std::move(measured);
    return response;
}

signals::HousingResponse ring_response(const Study& study, std::size_t sensor, int nodal_diameters,
                                       double frequency_factor) {
    return {.stiff_path = false,
            .modes = modes_at(study, sensor, nodal_diameters, frequency_factor),
            .measured = {},
            .chain = measuring_chain(study, sensor)};
}

}  // namespace gearpod::mc
