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

}  // namespace gearpod::mc
