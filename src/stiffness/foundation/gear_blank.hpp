// Gear blank factor: fraction of the mesh stiffness that remains where a gear is not a solid disc
// but a rim on a thinner web. ISO 6336-1:2006, 9.3.2.3, for webs in the middle of the face width,
//
//     C_R = 1 + ln(b_s / b) / (5 exp(s_R / (5 m_n))),    0.2 <= b_s / b <= 1.2,  s_R / m_n >= 1.
//
// Values outside these limits are replaced by the limit, as in the standard. b_s: web, b: face
// width, s_R: rim below the tooth's root, m_n: normal module. The factor is a fit to the stiffness
// of the whole pair, contact included, of external gears with a mating gear at least as stiff. A
// web wider than the face (a hub) makes the pair stiffer.
#pragma once

namespace gearpod::stiffness {

double gear_blank_factor(double web_over_face, double rim_over_module);

}  // namespace gearpod::stiffness
