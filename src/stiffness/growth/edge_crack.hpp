// Geometry factors F of a single edge crack of depth a in a strip of width w, K_I = sigma sqrt(pi
// a) F(a / w), sigma the stress without the crack, of bending that at the cracked edge. Polynomials
// times (1 - a / w)^(-3/2), the law of a vanishing ligament, within 0.15 % of the values that A. C.
// Kaya, F. Erdogan, Quart. Appl. Math. 45 (1987), 105-122, solve integral equations for, and of the
// ligament's limit, 3.975 of its moment (H. Tada, P. C. Paris, G. R. Irwin, The Stress Analysis of
// Cracks Handbook, 1985). That handbook's closed form for bending lies 2 % below these at 0.3.
#pragma once

namespace gearpod::stiffness {

double edge_crack_tension(double share);
double edge_crack_bending(double share);

}  // namespace gearpod::stiffness
