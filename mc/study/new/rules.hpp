// Rules of thumb for values missing in a datasheet. SI units.
// Sources:
// - Shigley: Budynas, Nisbett, Shigley's Mechanical Engineering Design, chapters 13 and 14.
// - AGMA 2001-D04, annex B, and Shigley, section 14-16: the rim-thickness factor.
// - Kraemer: Dynamics of Rotors and Foundations (1993), section 3.4, after Palmgren's deflection of
//   a roller between two races, delta = 7.68e-5 Q^0.9 / l^0.8 mm (N, mm), with Stribeck's Q = 4.08
//   F / Z.
// - ISO 286-1:2010: the standard tolerance factor.
#pragma once

#include "gears/gear.hpp"

namespace gearpod::mc {

inline constexpr double kSteelDensity_kg_m3 = 7850.0;

// Face width of four circular pitches; Shigley's rule is three to five.
double default_face_width_m(double normal_module_m);

// Rim thickness under the teeth: 1.2 tooth heights, the backup ratio from which the rim does not
// weaken the tooth root (AGMA).
double default_rim_m(double tooth_height_m);

// Least ratio of bore to root circle, for gears with few teeth whose rim would close the bore;
// chosen.
inline constexpr double kMinBoreRatio = 0.3;

// Height of a gear's teeth from root to tip.
double tooth_height_m(const gears::Gear& gear);
// Radius of the bore that leaves a rim of default_rim_m() under the teeth of an external gear.
double default_bore_radius_m(const gears::Gear& gear);

// Steel ring. Radii in metres.
struct Annulus {
    double outer_m = 0, inner_m = 0, width_m = 0;

    double mass_kg() const;
    double inertia_kg_m2() const;
};

// Cylindrical roller bearing of several rows that share the load.
struct RollerBearing {
    int rollers = 0;  // per row
    int rows = 1;
    double roller_length_m = 0, inner_diameter_m = 0;

    // Tangent stiffness under a radial load: 1e9 Z^0.9 l^0.8 F^0.1 per row (Kraemer).
    double stiffness_N_m(double load_N) const;
};
// Returns the bearing that fills a bore: two rows over 0.7 of the width. In units of the bore, the
// roller diameter is 0.14, the pitch circle 0.77 and the inner diameter 0.55. Rollers are 1.2
// roller diameters apart. The inner diameter is that of dimension series 22 (ISO 15); the rest is
// chosen.
RollerBearing bearing_in_bore(double bore_m, double width_m);

// Two roller bearings on a shaft of that diameter, one at each side of its gear, as one bearing of
// two rows. Proportions as above; the width is 0.25 of the outer diameter (dimension series 22).
RollerBearing bearings_on_shaft(double shaft_diameter_m);

// Torsional stiffness of a steel shaft of ten diameters' length, N m/rad (chosen).
double shaft_torsion_N_m_rad(double diameter_m);

// Damping of a rolling bearing: 1e-5 s times the stiffness; Kraemer gives 0.25e-5 to 2.5e-5 s.
double bearing_damping_N_s_m(double stiffness_N_m);

// Standard tolerance of grade 7 (ISO 286-1), 16 i, with i = 0.45 D^(1/3) + 0.001 D um up to 500 mm
// and 0.004 D + 2.1 um above (D in mm).
double grade_7_tolerance_m(double size_m);

}  // namespace gearpod::mc
