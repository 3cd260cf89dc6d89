// Reads faulty bearings as a study file lists them: [{ fault = "outer", shaft = "sun", elements =
// 9, diameter_ratio = 0.2, amplitude_m_s2 = 3, resonance_Hz = 2500 }].
#pragma once

#include <string>
#include <vector>

#include "mc/study/elements/list_element.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

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

}  // namespace gearpod::mc
