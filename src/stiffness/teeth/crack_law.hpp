// Laws by which a crack reduces the stiffness of a tooth.
#pragma once

namespace gearpod::stiffness {

// Choice of the crack law.
//     sections            The sources' law: the crack reduces the beam's sections (crack.hpp).
//                         Depth is measured from the root section's end.
//     fracture_mechanics  The whole beam plus the compliance added by the crack's stress
//                         intensities (crack_compliance.hpp). Depth is measured from the flank at
//                         the critical section.
enum class CrackLaw { sections, fracture_mechanics };

}  // namespace gearpod::stiffness
