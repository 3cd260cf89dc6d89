// Properties common to all kinds of crack: angle, stiffness law and largest depth.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "mc/study/faults/fault_kind.hpp"
#include "mc/study/keys/schema_line.hpp"
#include "stiffness/teeth/fracture_mechanics.hpp"

namespace gearpod::mc {

struct CrackShape : FaultShape {
    double angle_rad = 0.78539816339744828;  // 45 degrees, Liang (2016), section 3.1
    std::optional<stiffness::CrackLaw> law;  // by default crack_law() of the tooth profile

    bool operator==(const CrackShape&) const = default;
};

inline constexpr ChoiceName kCrackLaws[] = {
    name("sections", stiffness::CrackLaw::sections),
    name("fracture-mechanics", stiffness::CrackLaw::fracture_mechanics)};

// clang-format off
inline constexpr FaultKey kCrackAngle{"angle_deg", number<&CrackShape::angle_rad>, kDeg, inside(0, 90), Need::optional, "the stiffness tables of cracked teeth are computed for one angle", "angle between crack and tooth centre line; for a spatial crack, at the face where it starts"};
inline constexpr FaultKey kCrackLaw{"crack_law", choice<&CrackShape::law>(kCrackLaws), kNone, kAny, Need::optional, kFaultShape, "stiffness model of a cracked tooth: \"sections\" (weaker beam sections, as in the published models) or \"fracture-mechanics\" (from the critical section; the default for teeth with fillets)"};
// clang-format on

double crack_angle_rad(const Study& study);
// Stiffness law of the study's cracks: the given one, else fracture mechanics for teeth with
// fillets and sections for other profiles.
stiffness::CrackLaw crack_law(const Study& study);

// Depth at which the faulty member's tooth, of given geometry, is cut through, m.
double max_crack_depth_m(const Study& study);
// Thickness of that tooth at the section where its cracks start, m.
double critical_section_m(const Study& study);
// Text for the user: where the cracks start, the tooth thickness there, and the fraction of that
// section that each of these depths takes.
std::string crack_origin(const Study& study, std::span<const double> depths_m);
// "than the tooth (a crack at 45 deg leaves it after 4.2 mm)".
std::string deeper_than_tooth_text(const Study& study);

}  // namespace gearpod::mc
