// The shape of a crack that is no plane: depth, height and angle along the face width, and how it
// grows. Source: Yang (2022), Eqs. 61-66; the text at hand has lost signs and roots, so the forms
// are those that their limits leave:
//
//     depth    q(z) = q1 sqrt((L_c - z) / L_c)                 partial width: q1 at 0, 0 at L_c
//              q(z) = sqrt((q2^2 - q1^2) z / L + q1^2)         full width: q1 at 0, q2 at L
//     height   l(z) = (l2 - l1) (z / L)^2 + l1 [+ (l2 - l1) / a sin(b pi z / L)]
//     angle    g(z) = (g2 - g1) z / L + g1
//
// In both depths z is a square of q: a parabola lying along the width. Without its root the first
// would be a straight line, which he calls neither it nor the second, and the second's q1^2 would
// not be a length. The square of the height's is printed. The wave's (l2 - l1) stands without the
// brackets that it has in the first term, as the numerator over a. One form covers both depths, and
// the growth from one to the other: a parabola from q1 at 0 to q2 at L_c, nothing beyond.
#pragma once

#include <string>
#include <vector>

#include "stiffness/teeth/crack.hpp"

namespace gearpod::stiffness {

// Lengths in metres.
struct CrackSurface {
    double depth_m = 0, end_depth_m = 0;       // q1, q2
    double length_m = 0;                       // L_c, along the face width
    double height_m = 0, end_height_m = 0;     // l1, l2, of the start above the root section
    double angle_rad = 0, end_angle_rad = 0;   // g1, g2
    double height_wave = 0, height_waves = 0;  // a, b; without a wave where a = 0
    double face_width_m = 0;                   // L

    bool cracked() const { return length_m > 0 && (depth_m > 0 || end_depth_m > 0); }
    // The same crack all along its length.
    bool uniform() const;
    // Along the crack's length by t, 0 to 1, in which its depth is linear and all else smooth.
    double place(double t) const;       // z
    double stretching(double t) const;  // dz/dt
    Crack crack(double t) const;
    double height(double z) const;  // never below the root section
};

// Stages of growth. At stage k = 1, 2, ... the crack is entry k - 1 of the lists, in between it is
// interpolated; below stage 1 the depths grow from nothing, at the lengths and heights of entry 0.
struct CrackGrowth {
    std::vector<double> depth_m, end_depth_m, length_m, height_m, end_height_m;
    double angle_rad = 0, end_angle_rad = 0;
    double height_wave = 0, height_waves = 0;
    int slices = 16;  // at which the tooth's sections are looked at; rounded up to eights

    int stages() const { return static_cast<int>(depth_m.size()); }
    // Stages above the last count as it.
    CrackSurface at(double stage, double face_width_m) const;
};

// What is wrong with such a growth in a tooth of that face width, one sentence each; empty if
// nothing is.
std::vector<std::string> growth_problems(const CrackGrowth& growth, double face_width_m);

}  // namespace gearpod::stiffness
