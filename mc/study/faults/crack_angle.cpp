#include "mc/study/faults/crack_angle.hpp"

#include <fmt/format.h>

#include "mc/study/faults/limits.hpp"
#include "mc/study/gears.hpp"
#include "stiffness/teeth/crack.hpp"
#include "stiffness/teeth/tooth_profile.hpp"

namespace gearpod::mc {

double crack_angle_rad(const Study& study) {
    return study.fault.shapes.get<CrackAngle>().angle_rad;
}

double max_crack_depth_m(const Study& study) {
    const stiffness::ToothProfile tooth(gear_of(study, study.fault.member.value()),
                                        profile_of(study));
    return stiffness::max_crack_depth(tooth, crack_angle_rad(study));
}

std::string than_the_tooth(const Study& study) {
    return fmt::format("than the tooth (a crack at {:.4g} deg leaves it after {} mm)",
                       crack_angle_rad(study) * 180.0 / kPi,
                       shown(max_crack_depth_m(study) * kMmPerM));
}

}  // namespace gearpod::mc
