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

// Reads interfering tones as a study file lists them: [{ frequency_Hz = 50, amplitude_m_s2 = 0.1 },
// { shaft = "sun", order = 2, amplitude_m_s2 = 0.1 }].

inline constexpr TableField kToneFields[] = {{"frequency_Hz"},
                                             {.name = "amplitude_m_s2", .required = true},
                                             {"shaft", TableField::Kind::text, false, kShafts},
                                             {"order"}};
// Problems name the tone by its position in the list.
std::vector<Tone> read_tones(const Value& list, const RejectElement& reject);

// Table with all values, which reads back to the same tone.
std::string tone_table(const Tone& tone);

// Reads faulty bearings as a study file lists them: [{ fault = "outer", shaft = "sun", elements =
// 9, diameter_ratio = 0.2, amplitude_m_s2 = 3, resonance_Hz = 2500 }].

inline constexpr ChoiceName kBearingFaults[] = {{"outer", static_cast<int>(BearingFault::outer)},
                                                {"inner", static_cast<int>(BearingFault::inner)},
                                                {"roller", static_cast<int>(BearingFault::roller)},
                                                {"cage", static_cast<int>(BearingFault::cage)}};
inline constexpr TableField kBearingFields[] = {
    {"fault", TableField::Kind::text, true, kBearingFaults},
    {"shaft", TableField::Kind::text, false, kShafts},
    {"shaft_Hz"},
    {"elements", TableField::Kind::integer, true},
    {.name = "diameter_ratio", .required = true},
    {"contact_angle_deg"},
    {.name = "amplitude_m_s2", .required = true},
    {.name = "resonance_Hz", .required = true},
    {"damping"},
    {"slip"},
    {"load_zone_deg"},
    {"role", TableField::Kind::text, false, kSourceRoles}};
// Problems name the bearing by its position in the list.
std::vector<Bearing> read_bearings(const Value& list, const RejectElement& reject);

// Table with all values, which reads back to the same bearing.
std::string bearing_table(const Bearing& bearing);

// Reads neighbouring stages as a study file lists them: [{ name = "first", study = "first.toml",
// shaft = "sun", stage_shaft = "carrier", gain = 0.5 }].

inline constexpr TableField kStageFields[] = {
    {"name", TableField::Kind::word, true},
    {"study", TableField::Kind::text},
    {"text", TableField::Kind::text},
    {"shaft", TableField::Kind::text, true, kShafts},
    {"stage_shaft", TableField::Kind::text, true, kShafts},
    {"of", TableField::Kind::word},
    {"gain"},
    {"shaft_stiffness_N_m_rad"},
    {"shaft_damping_ratio"},
    {"role", TableField::Kind::text, false, kSourceRoles}};
// Problems name the stage by its position in the list. `study` is a file relative to the folder of
// the study; `text` is such a file's content, as results store it.
std::vector<NeighbourStage> read_stages(const Value& list, const RejectElement& reject);

// Table with all values, which reads back to the same stage.
std::string stage_table(const NeighbourStage& stage);

}  // namespace gearpod::mc
