#include "mc/study/elements/additional_sensors.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "mc/study/elements/housing_modes.hpp"

namespace gearpod::mc {

std::vector<AdditionalSensor> read_additional_sensors(const Value& list,
                                                      const RejectElement& reject) {
    std::vector<AdditionalSensor> sensors;
    for (std::size_t i = 0; i < list.elements.size(); ++i) {
        const std::string which = fmt::format("sensor {}", i + 1);
        const ListElement element(list.elements[i], which, kSensorFields,
                                  "write { name = \"side\", angle_deg = 90 }", reject);
        AdditionalSensor sensor;
        sensor.name = element.word("name");
        if (sensor.name == "first") {
            reject(fmt::format("{}: the name \"first\" is that of the study's own sensor", which),
                   "use another name");
        }
        if (std::ranges::find(sensors, sensor.name, &AdditionalSensor::name) != sensors.end() &&
            !sensor.name.empty()) {
            reject(fmt::format("{}: another one has the name \"{}\", too", which, sensor.name),
                   "give each its own");
        }
        sensor.angle_deg = element.number("angle_deg", {-360.0, 360.0});
        sensor.tangential = element.choice("direction", kDirections, false).value_or(0) == 1;
        sensor.gain = element.number("gain", kAbove0, 1.0);
        sensor.noise = element.number("noise", {.low = 0.0}, 1.0);
        sensor.participation = element.numbers("participation", kParticipation);
        sensor.response_gain = element.numbers("response_gain", {.low = 0.0});
        sensor.response_phase_deg = element.numbers("response_phase_deg", {-1e6, 1e6});
        sensors.push_back(sensor);
    }
    return sensors;
}

std::string sensor_table(const AdditionalSensor& sensor) {
    const auto list = [](const char* name, const std::vector<double>& values) {
        return values.empty() ? "" : fmt::format(", {} = [{}]", name, fmt::join(values, ", "));
    };
    return fmt::format(
        "{{ name = \"{}\", angle_deg = {}, direction = \"{}\", gain = {}, noise = {}{}{}{} }}",
        sensor.name, sensor.angle_deg, kDirections[sensor.tangential ? 1 : 0].text, sensor.gain,
        sensor.noise, list("participation", sensor.participation),
        list("response_gain", sensor.response_gain),
        list("response_phase_deg", sensor.response_phase_deg));
}

}  // namespace gearpod::mc
