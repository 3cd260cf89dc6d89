// Units of recorded columns, as they stand in brackets behind a name or in an attribute.
#pragma once

#include <optional>
#include <string>

namespace gearpod::mc {

enum class Quantity { acceleration, angle, time, speed, phase };

// What a value in that unit is times to be in m/s^2, rad, s, rpm or mesh periods; empty if the unit
// is unknown. No unit ("") is the one that is meant.
std::optional<double> unit_factor(Quantity quantity, const std::string& unit);

// "m/s^2, mm/s^2, g"
std::string known_units(Quantity quantity);

}  // namespace gearpod::mc
