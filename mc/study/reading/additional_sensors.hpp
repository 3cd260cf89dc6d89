// Reads further sensors as a study file lists them: [{ name = "side", angle_deg = 90 }].
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mc/study/reading/list_element.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

// Names in a table of the list.
std::vector<std::string_view> sensor_fields();
// Problems name the sensor by its position in the list.
std::vector<AdditionalSensor> read_additional_sensors(const Value& list,
                                                      const RejectElement& reject);

// Table with all values, which reads back to the same sensor.
std::string sensor_table(const AdditionalSensor& sensor);

}  // namespace gearpod::mc
