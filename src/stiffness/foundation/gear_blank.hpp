// What a mesh keeps of its stiffness where a gear is no solid disc but a rim on a thinner web:
// ISO 6336-1:2006, 9.3.2.3, the gear blank factor of webs in the middle of the face width,
//
//     C_R = 1 + ln(b_s / b) / (5 exp(s_R / (5 m_n))),    0.2 <= b_s / b <= 1.2,  s_R / m_n >= 1;
//
// beyond these limits the standard counts the limit. b_s: web, b: face width, s_R: rim below the
// tooth's root, m_n: normal module. A fit to the stiffness of the whole pair, contact included, of
// external gears whose mate is like them or stiffer; a web that reaches beyond the face (a hub)
// makes the pair stiffer.
#pragma once

namespace gearpod::stiffness {

double gear_blank_factor(double web_over_face, double rim_over_module);

}  // namespace gearpod::stiffness
