// The gears that a study describes.
#pragma once

#include "gears/gear.hpp"
#include "mc/study.hpp"

namespace gearpod::mc {

// The sun, a planet or the ring. The study must have tooth numbers and a module.
gears::Gear gear_of(const Gearbox& gearbox, Member member);

// Length of the longest crack that the faulty member's tooth holds, m: there it breaks. The study
// must have the tooth geometry and a crack.
double max_fault_depth_m(const Study& study);

}  // namespace gearpod::mc
