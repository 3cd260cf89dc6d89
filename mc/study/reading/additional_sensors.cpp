#include "mc/study/reading/additional_sensors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace gearpod::mc {
namespace {

constexpr std::array kDirections{ChoiceName{"radial", 0}, ChoiceName{"tangential", 1}};

}  // namespace

std::vector<std::string_view> sensor_fields() {
    return {"name", "angle_deg", "direction", "gain", "noise"};
}

std::vector<AdditionalSensor> read_additional_sensors(const Value& list,
                                                      const RejectElement& reject) {
    constexpr Range kAbove0{.low = 0.0, .low_open = true};
    std::vector<AdditionalSensor> sensors;
    for (std::size_t i = 0; i < list.elements.size(); ++i) {
        const std::string which = fmt::format("sensor {}", i + 1);
        const ListElement element(list.elements[i], which, sensor_fields(),
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
        sensors.push_back(sensor);
    }
    return sensors;
}

std::string sensor_table(const AdditionalSensor& sensor) {
    return fmt::format(
        "{{ name = \"{}\", angle_deg = {}, direction = \"{}\", gain = {}, noise = {} }}",
        sensor.name, sensor.angle_deg, kDirections[sensor.tangential ? 1 : 0].text, sensor.gain,
        sensor.noise);
}

}  // namespace gearpod::mc
