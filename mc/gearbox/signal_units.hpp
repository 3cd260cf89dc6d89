// Units of recorded columns, as written in brackets after a name or in an attribute.
#pragma once

#include <optional>
#include <string>

namespace gearpod::mc {

enum class Quantity { acceleration, angle, time, speed, phase };

// Factor that converts this unit to m/s^2, rad, s, rpm or mesh periods; empty if the unit is
// unknown. The empty unit "" means one of these.
std::optional<double> unit_factor(Quantity quantity, const std::string& unit);

// List of the known units, for example "m/s^2, mm/s^2, g".
std::string known_units(Quantity quantity);

}  // namespace gearpod::mc
