// Reads natural modes of the housing as a study file lists them: [{ frequency_Hz = 420, damping =
// 0.03, participation = 0.8 }].
#pragma once

#include <string>
#include <vector>

#include "mc/study/elements/list_element.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

inline constexpr TableField kHousingFields[] = {{.name = "frequency_Hz", .required = true},
                                                {.name = "damping", .required = true},
                                                {.name = "participation", .required = true},
                                                {"nodal_diameters", TableField::Kind::integer},
                                                {"sun_bearing_per_kg"},
                                                {"carrier_bearing_per_kg"}};
inline constexpr Range kParticipation{-1000.0, 1000.0};

// Problems name the mode by its position in the list.
std::vector<HousingMode> read_housing_modes(const Value& list, const RejectElement& reject);

// Table with all values, which reads back to the same mode.
std::string housing_table(const HousingMode& mode);

// Reads further sensors as a study file lists them: [{ name = "side", angle_deg = 90 }].

inline constexpr ChoiceName kDirections[] = {{"radial", 0}, {"tangential", 1}};
inline constexpr TableField kSensorFields[] = {
    {"name", TableField::Kind::word, true},
    {.name = "angle_deg", .required = true},
    {"direction", TableField::Kind::text, false, kDirections},
    {"gain"},
    {"noise"},
    {"participation", TableField::Kind::numbers},
    {"response_gain", TableField::Kind::numbers},
    {"response_phase_deg", TableField::Kind::numbers},
    {"sun_bearing_per_kg", TableField::Kind::numbers},
    {"sun_response_gain", TableField::Kind::numbers},
    {"sun_response_phase_deg", TableField::Kind::numbers},
    {"carrier_bearing_per_kg", TableField::Kind::numbers},
    {"carrier_response_gain", TableField::Kind::numbers},
    {"carrier_response_phase_deg", TableField::Kind::numbers},
    {"sampling_Hz"},
    {"low_pass_Hz"},
    {"mounting_Hz"},
    {"mounting_damping"},
    {"delay_s"},
    {"quantisation_m_s2"},
    {"range_m_s2"}};
// Problems name the sensor by its position in the list.
std::vector<AdditionalSensor> read_additional_sensors(const Value& list,
                                                      const RejectElement& reject);

// Table with all values, which reads back to the same sensor.
std::string sensor_table(const AdditionalSensor& sensor);

}  // namespace gearpod::mc
