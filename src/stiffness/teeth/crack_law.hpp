// How a crack makes a tooth softer.
#pragma once

namespace gearpod::stiffness {

//  sections            The sources' law: the beam keeps what the crack leaves of its sections
//                      (crack.hpp). Depth counts from the root section's end.
//  fracture_mechanics  The whole beam, and what the crack's stress intensities add to its
//  compliance
//                      (crack_compliance.hpp). Depth counts from the flank at the critical section.
enum class CrackLaw { sections, fracture_mechanics };

}  // namespace gearpod::stiffness
