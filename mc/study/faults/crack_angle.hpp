// The angle that all kinds of crack have, and how deep one can go at it.
#pragma once

#include <string>

#include "mc/study/faults/fault_kind.hpp"
#include "mc/study/keys/access.hpp"
#include "mc/study/keys/units.hpp"

namespace gearpod::mc {

struct CrackAngle : FaultShape {
    double angle_rad = 0.78539816339744828;  // 45 degrees, Liang (2016), section 3.1

    bool operator==(const CrackAngle&) const = default;
};

// clang-format off
inline constexpr FaultKey kCrackAngle{"angle_deg", number<&CrackAngle::angle_rad>, kDeg, inside(0, 90), Need::optional, "the tables of cracked teeth hold for one angle", "angle between crack and tooth centre line; of a spatial crack where it begins"};
// clang-format on

double crack_angle_rad(const Study& study);

// Length of the longest crack that the faulty member's tooth holds, m: there it breaks. The study
// must have the tooth geometry.
double max_crack_depth_m(const Study& study);
// "than the tooth (a crack at 45 deg leaves it after 4.2 mm)".
std::string than_the_tooth(const Study& study);

}  // namespace gearpod::mc
