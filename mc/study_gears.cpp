#include "mc/study_gears.hpp"

#include "stiffness/faults/crack.hpp"
#include "stiffness/tooth_profile.hpp"

namespace gearpod::mc {

gears::Gear gear_of(const Gearbox& gearbox, Member member) {
    gears::Gear gear;
    gear.teeth = member == Member::sun    ? gearbox.sun_teeth.value()
                 : member == Member::ring ? gearbox.ring_teeth.value()
                                          : gearbox.planet_teeth.value();
    gear.internal = member == Member::ring;
    gear.module_m = gearbox.module_m.value();
    gear.pressure_angle_rad = gearbox.pressure_angle_rad;
    gear.addendum_coefficient = gearbox.addendum_coefficient;
    gear.dedendum_coefficient = gearbox.dedendum_coefficient;
    return gear;
}

double max_fault_depth_m(const Study& study) {
    const auto profile = study.gearbox.tooth_profile == ToothProfile::base_circle
                             ? stiffness::Profile::base_circle
                             : stiffness::Profile::root_circle;
    const stiffness::ToothProfile tooth(gear_of(study.gearbox, study.fault.member.value()),
                                        profile);
    return stiffness::max_crack_depth(tooth, study.fault.angle_rad);
}

}  // namespace gearpod::mc
