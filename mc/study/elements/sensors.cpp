#include "mc/study/elements/sensors.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "mc/study/housing.hpp"

namespace gearpod::mc {

std::vector<HousingMode> read_housing_modes(const Value& list, const RejectElement& reject) {
    std::vector<HousingMode> modes;
    for (std::size_t i = 0; i < list.elements.size(); ++i) {
        const ListElement element(
            list.elements[i], fmt::format("mode {}", i + 1), kHousingFields,
            "write { frequency_Hz = 420, damping = 0.03, participation = 0.8 }", reject);
        HousingMode mode;
        mode.frequency_Hz = element.number("frequency_Hz", {.low = 1.0});
        mode.damping = element.number("damping", {0.001, 1.0});
        mode.participation = element.number("participation", kParticipation);
        if (element.has("nodal_diameters")) {
            mode.nodal_diameters = element.integer("nodal_diameters", {0.0, 100.0});
        }
        for (const HousingBearing& bearing : kHousingBearings) {
            mode.*bearing.per_kg = element.number(bearing.per_kg_name, kParticipation, 0.0);
        }
        modes.push_back(mode);
    }
    return modes;
}

std::string housing_table(const HousingMode& mode) {
    std::string more =
        mode.nodal_diameters ? fmt::format(", nodal_diameters = {}", *mode.nodal_diameters) : "";
    for (const HousingBearing& bearing : kHousingBearings) {
        if (mode.*bearing.per_kg != 0.0) {
            more += fmt::format(", {} = {}", bearing.per_kg_name, mode.*bearing.per_kg);
        }
    }
    return fmt::format("{{ frequency_Hz = {}, damping = {}, participation = {}{} }}",
                       mode.frequency_Hz, mode.damping, mode.participation, more);
}

namespace {

constexpr Range kGain{.low = 0.0}, kPhase_deg{-1e6, 1e6};

void read_chain(const ListElement& element, AdditionalSensor& sensor) {
    const auto number = [&](const char* name, const Range& range) {
        return element.has(name) ? std::optional(element.number(name, range)) : std::nullopt;
    };
    sensor.sampling_Hz = number("sampling_Hz", kAbove0);
    sensor.low_pass_Hz = number("low_pass_Hz", kAbove0);
    sensor.mounting_Hz = number("mounting_Hz", {.low = 1.0});
    sensor.mounting_damping =
        element.number("mounting_damping", {0.001, 1.0}, sensor.mounting_damping);
    if (element.has("mounting_damping") && !sensor.mounting_Hz) {
        element.reject("mounting_damping is given, but no mounting_Hz",
                       "give the natural frequency of the mounting, too");
    }
    sensor.delay_s = element.number("delay_s", {-1.0, 1.0}, 0.0);
    sensor.quantisation_m_s2 = number("quantisation_m_s2", {.low = 0.0});
    sensor.range_m_s2 = number("range_m_s2", kAbove0);
}

// Entries of the measuring chain in a table.
std::string chain_text(const AdditionalSensor& sensor) {
    std::string text;
    const auto add = [&](const char* name, std::optional<double> value) {
        text += value ? fmt::format(", {} = {}", name, *value) : "";
    };
    add("sampling_Hz", sensor.sampling_Hz);
    add("low_pass_Hz", sensor.low_pass_Hz);
    add("mounting_Hz", sensor.mounting_Hz);
    if (sensor.mounting_Hz) {
        add("mounting_damping", sensor.mounting_damping);
    }
    if (sensor.delay_s != 0.0) {
        add("delay_s", sensor.delay_s);
    }
    add("quantisation_m_s2", sensor.quantisation_m_s2);
    add("range_m_s2", sensor.range_m_s2);
    return text;
}

}  // namespace

std::vector<AdditionalSensor> read_additional_sensors(const Value& list,
                                                      const RejectElement& reject) {
    std::vector<AdditionalSensor> sensors;
    for (std::size_t i = 0; i < list.elements.size(); ++i) {
        const ListElement element(list.elements[i], fmt::format("sensor {}", i + 1), kSensorFields,
                                  "write { name = \"side\", angle_deg = 90 }", reject);
        AdditionalSensor sensor;
        sensor.name = element.word("name");
        if (sensor.name == "first") {
            element.reject("the name \"first\" is that of the study's own sensor",
                           "use another name");
        }
        if (std::ranges::find(sensors, sensor.name, &AdditionalSensor::name) != sensors.end() &&
            !sensor.name.empty()) {
            element.reject(fmt::format("another one has the name \"{}\", too", sensor.name),
                           "give each its own");
        }
        sensor.angle_deg = element.number("angle_deg", {-360.0, 360.0});
        sensor.tangential = element.choice("direction", kDirections, false).value_or(0) == 1;
        sensor.gain = element.number("gain", kAbove0, 1.0);
        sensor.noise = element.number("noise", {.low = 0.0}, 1.0);
        sensor.participation = element.numbers("participation", kParticipation);
        sensor.response_gain = element.numbers("response_gain", kGain);
        sensor.response_phase_deg = element.numbers("response_phase_deg", kPhase_deg);
        for (const HousingBearing& bearing : kHousingBearings) {
            sensor.*bearing.own_per_kg = element.numbers(bearing.per_kg_name, kParticipation);
            sensor.*bearing.own_gain = element.numbers(bearing.gain_name, kGain);
            sensor.*bearing.own_phase_deg = element.numbers(bearing.phase_name, kPhase_deg);
        }
        read_chain(element, sensor);
        sensors.push_back(sensor);
    }
    return sensors;
}

std::string sensor_table(const AdditionalSensor& sensor) {
    const auto list = [](const char* name, const std::vector<double>& values) {
        return values.empty() ? std::string()
                              : fmt::format(", {} = [{}]", name, fmt::join(values, ", "));
    };
    std::string bearings;
    for (const HousingBearing& bearing : kHousingBearings) {
        bearings += list(bearing.per_kg_name, sensor.*bearing.own_per_kg) +
                    list(bearing.gain_name, sensor.*bearing.own_gain) +
                    list(bearing.phase_name, sensor.*bearing.own_phase_deg);
    }
    return fmt::format(
        "{{ name = \"{}\", angle_deg = {}, direction = \"{}\", gain = {}, noise = {}{}{}{}{}{} }}",
        sensor.name, sensor.angle_deg, kDirections[sensor.tangential ? 1 : 0].text, sensor.gain,
        sensor.noise, list("participation", sensor.participation),
        list("response_gain", sensor.response_gain),
        list("response_phase_deg", sensor.response_phase_deg), bearings, chain_text(sensor));
}

}  // namespace gearpod::mc
