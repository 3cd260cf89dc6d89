// Units of REXS attributes.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gearpod::mc {

// Quantities that are read, each with the unit in which it is returned.
enum class RexsQuantity {
    number,     // none
    length,     // mm
    angle,      // deg
    modulus,    // Pa
    stiffness,  // N/m
    speed,      // rpm
    torque,     // N m
};

// Factor that converts a value of this unit to the quantity's unit. Blanks do not matter. Empty if
// the unit is not one of the quantity.
std::optional<double> rexs_factor(std::string_view unit, RexsQuantity quantity);

// Units of a quantity for messages: "mm, m, ...".
std::string rexs_units(RexsQuantity quantity);

}  // namespace gearpod::mc
