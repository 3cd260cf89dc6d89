#include "mc/rexs/rexs_units.hpp"

#include <array>
#include <numbers>

namespace gearpod::mc {
namespace {

struct RexsUnit {
    RexsQuantity quantity;
    std::string_view name;  // without blanks
    double factor;
};

using Q = RexsQuantity;
using std::numbers::pi;

// Units of REXS 1.0 to 1.6 first, then other spellings. "mum" is REXS's micrometre.
constexpr std::array kRexsUnits{
    RexsUnit{Q::number, "none", 1.0},
    RexsUnit{Q::number, "", 1.0},
    RexsUnit{Q::number, "-", 1.0},
    RexsUnit{Q::number, "1", 1.0},
    RexsUnit{Q::number, "%", 0.01},
    RexsUnit{Q::length, "mm", 1.0},
    RexsUnit{Q::length, "m", 1e3},
    RexsUnit{Q::length, "mum", 1e-3},
    RexsUnit{Q::length, "um", 1e-3},
    RexsUnit{Q::length, "\xc2\xb5m", 1e-3},
    RexsUnit{Q::length, "\xce\xbcm", 1e-3},
    RexsUnit{Q::length, "cm", 10.0},
    RexsUnit{Q::length, "dm", 100.0},
    RexsUnit{Q::length, "in", 25.4},
    RexsUnit{Q::angle, "deg", 1.0},
    RexsUnit{Q::angle, "\xc2\xb0", 1.0},
    RexsUnit{Q::angle, "rad", 180.0 / pi},
    RexsUnit{Q::angle, "mrad", 0.18 / pi},
    RexsUnit{Q::modulus, "N/mm^2", 1e6},
    RexsUnit{Q::modulus, "MPa", 1e6},
    RexsUnit{Q::modulus, "GPa", 1e9},
    RexsUnit{Q::modulus, "Pa", 1.0},
    RexsUnit{Q::modulus, "kPa", 1e3},
    RexsUnit{Q::modulus, "N/m^2", 1.0},
    RexsUnit{Q::modulus, "kN/mm^2", 1e9},
    RexsUnit{Q::modulus, "N/mm\xc2\xb2", 1e6},
    RexsUnit{Q::modulus, "N/m\xc2\xb2", 1.0},
    RexsUnit{Q::stiffness, "N/m", 1.0},
    RexsUnit{Q::stiffness, "N/mm", 1e3},
    RexsUnit{Q::stiffness, "N/mum", 1e6},
    RexsUnit{Q::stiffness, "N/um", 1e6},
    RexsUnit{Q::stiffness, "kN/mm", 1e6},
    RexsUnit{Q::stiffness, "kN/m", 1e3},
    RexsUnit{Q::stiffness, "MN/m", 1e6},
    RexsUnit{Q::speed, "1/min", 1.0},
    RexsUnit{Q::speed, "rpm", 1.0},
    RexsUnit{Q::speed, "U/min", 1.0},
    RexsUnit{Q::speed, "rev/min", 1.0},
    RexsUnit{Q::speed, "min^-1", 1.0},
    RexsUnit{Q::speed, "1/s", 60.0},
    RexsUnit{Q::speed, "Hz", 60.0},
    RexsUnit{Q::speed, "rad/s", 30.0 / pi},
    RexsUnit{Q::torque, "Nm", 1.0},
    RexsUnit{Q::torque, "kNm", 1e3},
    RexsUnit{Q::torque, "Nmm", 1e-3},
    RexsUnit{Q::torque, "MNm", 1e6},
};

}  // namespace

std::optional<double> rexs_factor(std::string_view unit, RexsQuantity quantity) {
    std::string name;
    for (const char c : unit) {
        if (c != ' ' && c != '\t') {
            name += c;
        }
    }
    for (const RexsUnit& candidate : kRexsUnits) {
        if (candidate.quantity == quantity && candidate.name == name) {
            return candidate.factor;
        }
    }
    return {};
}

std::string rexs_units(RexsQuantity quantity) {
    std::string list;
    for (const RexsUnit& unit : kRexsUnits) {
        if (unit.quantity == quantity && !unit.name.empty()) {
            list += (list.empty() ? "" : ", ") + std::string(unit.name);
        }
    }
    return list;
}

}  // namespace gearpod::mc
