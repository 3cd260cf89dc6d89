#include "mc/study/sensor_signal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "machine/contracts.hpp"
#include "mc/study/gears.hpp"

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

double projected_ratio(const Bearing& bearing) {
    return bearing.diameter_ratio * std::cos(bearing.contact_angle_deg * std::numbers::pi / 180.0);
}

double cage_order(const Bearing& bearing) {
    return 0.5 * (1.0 - projected_ratio(bearing));
}

std::string_view part_name(BearingFault fault) {
    switch (fault) {
        case BearingFault::outer:
            return "outer ring";
        case BearingFault::inner:
            return "inner ring";
        case BearingFault::roller:
            return "rolling element";
        case BearingFault::cage:
            return "cage";
    }
    return "";
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

bool noise_by_density(const Study& study) {
    return study.sensor.noise_density_m_s2_per_sqrt_Hz.has_value() || has_background(study);
}

bool has_background(const Study& study) {
    return !study.sensor.background_Hz.empty();
}

bool has_range(const Study& study) {
    return study.sensor.range_m_s2 ||
           std::ranges::any_of(study.sensor.additional, [](const AdditionalSensor& sensor) {
               return sensor.range_m_s2.has_value();
           });
}

signals::NoiseSpectrum background_spectrum(const Study& study) {
    EXPECTS(has_background(study));
    return {study.sensor.background_Hz, study.sensor.background_density_m_s2_per_sqrt_Hz};
}

NoiseModel noise_model(const Study& study) {
    NoiseModel model{study.sensor.quantisation_m_s2, study.sensor.low_pass_Hz, {}};
    if (has_background(study)) {
        model.background_rms_m_s2 = background_spectrum(study).rms_m_s2(model.low_pass_Hz);
    }
    return model;
}

SensorNoise sensor_noise(const NoiseModel& model, const SensorNoiseInputs& inputs) {
    const double step_m_s2 = model.quantisation_m_s2;
    SensorNoise noise;
    noise.white_m_s2 = step_m_s2 > 0.0 ? std::hypot(inputs.rms_m_s2, step_m_s2 / std::sqrt(12.0))
                                       : inputs.rms_m_s2;
    const double filtered_m_s2 = inputs.density_m_s2_per_sqrt_Hz.value_or(0.0) *
                                 std::sqrt(signals::low_pass_noise_bandwidth_Hz(model.low_pass_Hz));
    noise.all_m_s2 = !inputs.density_m_s2_per_sqrt_Hz ? noise.white_m_s2
                     : noise.white_m_s2 == 0.0        ? filtered_m_s2
                                                      : std::hypot(filtered_m_s2, noise.white_m_s2);
    if (model.background_rms_m_s2) {
        noise.background_m_s2 = inputs.background_level * *model.background_rms_m_s2;
        noise.all_m_s2 = std::hypot(noise.all_m_s2, noise.background_m_s2);
    }
    return noise;
}

double sensor_noise_m_s2(const Study& study) {
    const Sensor& s = study.sensor;
    return sensor_noise(noise_model(study),
                        {s.noise_density_m_s2_per_sqrt_Hz, s.noise_m_s2, s.background_level})
        .all_m_s2;
}

std::string noise_text(const Study& study) {
    const Sensor& s = study.sensor;
    const bool filtered = s.noise_density_m_s2_per_sqrt_Hz.has_value();
    std::string text =
        fmt::format("{:.4g} m/s^2 rms times the noise level", sensor_noise_m_s2(study));
    if (s.quantisation_m_s2 == 0.0 && (!filtered || s.noise_m_s2 == 0.0) &&
        !has_background(study)) {
        return text + (filtered ? ", white noise, filtered by the low-pass"
                                : ", white noise, not filtered by the low-pass");
    }
    text += ", in quadrature:";
    if (filtered) {
        text += fmt::format(" {:.4g} filtered by the low-pass,",
                            *s.noise_density_m_s2_per_sqrt_Hz *
                                std::sqrt(signals::low_pass_noise_bandwidth_Hz(s.low_pass_Hz)));
    }
    if (has_background(study)) {
        text +=
            fmt::format(" {:.4g} of the background,",
                        s.background_level * background_spectrum(study).rms_m_s2(s.low_pass_Hz));
    }
    return text + fmt::format(" {:.4g} white, {:.4g} by quantisation", s.noise_m_s2,
                              s.quantisation_m_s2 / std::sqrt(12.0));
}

const char* noise_key(const Study& study) {
    return study.sensor.noise_density_m_s2_per_sqrt_Hz ? "sensor.noise_density_m_s2_per_sqrt_Hz"
                                                       : "sensor.noise_m_s2";
}

double impulses_per_turn(const Bearing& bearing) {
    const double ratio = projected_ratio(bearing);
    switch (bearing.fault) {
        case BearingFault::outer:
            return 0.5 * bearing.elements * (1.0 - ratio);
        case BearingFault::inner:
            return 0.5 * bearing.elements * (1.0 + ratio);
        case BearingFault::roller:
            return (1.0 - ratio * ratio) / bearing.diameter_ratio;
        case BearingFault::cage:
            return cage_order(bearing);
    }
    return 0.0;
}

double load_turns_per_turn(const Bearing& bearing) {
    switch (bearing.fault) {
        case BearingFault::inner:
            return 1.0;
        case BearingFault::roller:
            return cage_order(bearing);
        case BearingFault::outer:
        case BearingFault::cage:
            break;
    }
    return 0.0;
}

bool has_other_sources(const Study& study) {
    return !study.sensor.bearings.empty() || !study.sensor.stages.empty();
}

bool is_coupled(const Study& study) {
    return std::ranges::any_of(study.sensor.stages, &NeighbourStage::coupled);
}

bool has_other_fault(const Study& study) {
    const auto is_fault = [](const auto& source) { return source.role == SourceRole::other_fault; };
    return std::ranges::any_of(study.sensor.bearings, is_fault) ||
           std::ranges::any_of(study.sensor.stages, is_fault);
}

std::string bearing_text(const Bearing& bearing) {
    return bearing.shaft
               ? fmt::format("{} of a bearing of the {}", part_name(bearing.fault),
                             member_name(*bearing.shaft))
               : fmt::format("{} of a bearing of another shaft", part_name(bearing.fault));
}

std::string other_fault_text(const Study& study) {
    std::string text;
    const auto add = [&](SourceRole role, const std::string& what) {
        if (role == SourceRole::other_fault) {
            text += (text.empty() ? "a fault of " : " and ") + what;
        }
    };
    for (const Bearing& bearing : study.sensor.bearings) {
        add(bearing.role, "the " + bearing_text(bearing));
    }
    for (const NeighbourStage& stage : study.sensor.stages) {
        add(stage.role, "the neighbouring stage \"" + stage.name + "\"");
    }
    return text;
}

}  // namespace gearpod::mc
