// Shape and growth of a crack whose depth, height and angle vary along the face width. Source: Yang
// (2022), Eqs. 61-66. The available text lacks signs and roots, so the forms are derived from their
// limits:
//
//     depth    q(z) = q1 sqrt((L_c - z) / L_c)                 partial width: q1 at 0, 0 at L_c
//              q(z) = sqrt((q2^2 - q1^2) z / L + q1^2)         full width: q1 at 0, q2 at L
//     height   l(z) = (l2 - l1) (z / L)^2 + l1 [+ (l2 - l1) / a sin(b pi z / L)]
//     angle    g(z) = (g2 - g1) z / L + g1
//
// In both depths z is quadratic in q: a parabola whose axis lies along the width. Without its root
// the first would be a straight line, contrary to the text, and the q1^2 of the second would not be
// a length. The square in the height is printed. The wave's (l2 - l1) is printed without the
// brackets of the first term, as the numerator over a. One form covers both depths and the growth
// from one to the other: a parabola from q1 at 0 to q2 at L_c, and no crack beyond.
#pragma once

#include <string>
#include <vector>

#include "stiffness/teeth/crack.hpp"

namespace gearpod::stiffness {

// Shape of a crack along the face width. Lengths in metres. The reference section is the root
// section, or by fracture mechanics the critical one.
struct CrackSurface {
    double depth_m = 0, end_depth_m = 0;       // q1, q2
    double length_m = 0;                       // L_c, along the face width
    double height_m = 0, end_height_m = 0;     // l1, l2, of the start above the reference section
    double angle_rad = 0, end_angle_rad = 0;   // g1, g2
    double height_wave = 0, height_waves = 0;  // a, b; a = 0: no wave
    double face_width_m = 0;                   // L

    bool cracked() const { return length_m > 0 && (depth_m > 0 || end_depth_m > 0); }
    // True if the crack is the same along its whole length.
    bool uniform() const;
    // Functions of the position t along the crack's length, 0 to 1, in which the depth is linear
    // and all other quantities are smooth.
    double place(double t) const;       // z
    double stretching(double t) const;  // dz/dt
    Crack crack(double t) const;
    double height(double z) const;  // never below the reference section
};

// Stages of crack growth. At stage k = 1, 2, ... the crack is entry k - 1 of the lists. Between
// stages it is interpolated. Below stage 1 the depths grow from 0 at the lengths and heights of
// entry 0.
struct CrackGrowth {
    std::vector<double> depth_m, end_depth_m, length_m, height_m, end_height_m;
    double angle_rad = 0, end_angle_rad = 0;
    double height_wave = 0, height_waves = 0;
    int slices = 16;  // number of slices of the tooth; rounded up to a multiple of eight

    int stages() const { return static_cast<int>(depth_m.size()); }
    // Crack at a stage of growth. Stages above the last are treated as the last.
    CrackSurface at(double stage, double face_width_m) const;
};

// Errors of such a growth in a tooth of the given face width, one sentence each; empty if there are
// none.
std::vector<std::string> growth_problems(const CrackGrowth& growth, double face_width_m);

}  // namespace gearpod::stiffness
