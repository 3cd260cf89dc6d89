// Geometry factors F of a single edge crack of depth a in a strip of width w: K = sigma sqrt(pi a)
// F(a / w). sigma is the nominal stress of the uncracked strip (tension, bending at the cracked
// edge, or mean shear). `share` is a / w.
//
// Tension and bending are polynomials times (1 - a / w)^(-3/2), the law of a vanishing ligament.
// They lie within 0.15 % of the integral-equation solutions of A. C. Kaya, F. Erdogan, Quart. Appl.
// Math. 45 (1987), 105-122, and reach the ligament's limit K_I = 3.975 M / b^(3/2) (H. Tada, P. C.
// Paris, G. R. Irwin, The Stress Analysis of Cracks Handbook, 1985). The closed form for bending
// often quoted from the handbook, with (1 - sin)^4, is 2.3 % lower at a / w = 0.3. Shear (K_II) is
// the handbook's form for a uniform shear stress.
#pragma once

namespace gearpod::stiffness {

double edge_crack_tension(double share);
double edge_crack_bending(double share);
double edge_crack_shear(double share);

}  // namespace gearpod::stiffness
