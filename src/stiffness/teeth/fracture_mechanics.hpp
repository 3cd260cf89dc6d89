// Laws by which a crack reduces the stiffness of a tooth.
#pragma once

#include <vector>

#include "stiffness/teeth/material.hpp"
#include "stiffness/teeth/tooth_profile.hpp"

namespace gearpod::stiffness {

// Choice of the crack law.
//     sections            The sources' law: the crack reduces the beam's sections (crack.hpp).
//                         Depth is measured from the root section's end.
//     fracture_mechanics  The whole beam plus the compliance added by the crack's stress
//                         intensities (CrackCompliance). Depth is measured from the flank at
//                         the critical section.
enum class CrackLaw { sections, fracture_mechanics };

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
double edge_crack_tension(double share);
double edge_crack_bending(double share);
double edge_crack_shear(double share);

// Path of a crack that starts on the loaded flank, and the stress intensity at its tip. Lengths in
// metres, angles in radians.
//
// The crack starts at the critical section (ToothProfile::critical) or some height above it. It
// runs into the body at the angle v to the tooth's centre line. Beyond the centre line it rises at
// the same angle to the other flank's point at the height of the start. These are the two straight
// parts of Liang (2016), section 3.5, Fig. 3.9. The crack has cut the tooth after the length 2 h /
// sin v, where h is the half thickness at the start. The ligament is the straight line from the tip
// to that point.
//
// The mesh force on the tooth, taken about the middle of crack and ligament, is a normal force N, a
// shear force V and a moment M. In a strip as wide as crack and ligament together, w = a + b, they
// cause the stress intensities
//
//     K_I  = (m N / w F_t(a/w) + 6 (m M + k V w) / w^2 F_b(a/w)) sqrt(pi a) / L,
//     K_II = V / w F_s(a/w) sqrt(pi a) / L.
//
// A strip under remote loads has m = 1 and k = 0. A tooth is short and ends in a fillet or corner.
// Near the surface the moment has a larger effect, and the shear force adds a lever of k w. The
// stress correction factor of ISO 6336-3 is similar (for these teeth Y_S h_Fe = 1.33 (h_Fe + 0.28
// s_Fn)). Both factors fade with depth, m = m_d + (m_0 - m_d) exp(-a / 0.087 l) and k likewise,
// where l is the crack's whole length. The moment of a deep crack acts on its ligament only, and
// the body below it reduces the factor to 0.88. The factors are calibrated with finite elements of
// whole gears (docs/methods/faults.md), separately for teeth with a fillet and for teeth that end
// in a corner.
//
// Omitted: contact between the crack's faces.

// Stress intensities for a unit force on the tooth and a unit face width, m^(-1/2), as functions of
// the contact angle: linear in its cosine and sine. A negative K_I closes the crack.
struct CrackIntensity {
    double constant = 0, cosine = 0, sine = 0;    // K_I
    double sliding_cosine = 0, sliding_sine = 0;  // K_II
    double opening(double cos, double sin) const { return constant + cosine * cos + sine * sin; }
    double sliding(double cos, double sin) const {
        return sliding_cosine * cos + sliding_sine * sin;
    }
};

class CrackPath {
  public:
    // angle_rad: between crack and centre line, 0 < v <= pi/2. height_m: height of the start above
    // the critical section, along the centre line; not negative.
    CrackPath(const ToothProfile& profile, double angle_rad, double height_m = 0);

    double start() const { return start_; }  // u of ToothProfile
    // Thickness of the tooth at the start.
    double thickness() const { return 2 * half_thickness_; }
    // Depths along the crack at which it turns on the centre line, and at which it has cut the
    // tooth.
    double turn() const { return half_thickness_ / sine_; }
    double length() const { return 2 * turn(); }
    // Length of the ligament, m.
    double ligament(double depth_m) const;
    // Stress intensity at the tip, 0 < depth_m < length().
    CrackIntensity intensity(double depth_m) const;

  private:
    struct Vector {
        double x, y;  // from the start's section to the tip; to the loaded flank
    };
    Vector tip_to_end(double depth_m) const;

    double cosine_, sine_;  // of the crack's angle
    double sense_, base_radius_;
    bool fillet_;
    double start_ = 0, axial_ = 0, half_thickness_ = 0;
};

// Depth along a crack, from its start, at which it has cut the tooth by the given law.
double max_crack_depth(const ToothProfile& profile, CrackLaw law, double angle_rad);

// Compliance that a crack adds to a tooth, by linear elastic fracture mechanics. The energy release
// rate is integrated over the crack's area (Irwin 1957; Paris' appendix in H. Tada, P. C. Paris, G.
// R. Irwin, The Stress Analysis of Cracks Handbook; A. D. Dimarogonas, S. A. Paipetis, Analytical
// Methods in Rotor Dynamics, 1983),
//
//     delta c = 2 (1 - nu^2) / E  L  integral over the depth of (K_I^2 + K_II^2) / F^2 da,
//
// in plane strain, with the intensities above. The beam keeps all its sections. A crack
// closed by the force is treated as open (linear, as in the finite elements).
class CrackCompliance {
  public:
    // depth_m: along the crack, not negative.
    CrackCompliance(const CrackPath& path, const Material& material, double depth_m);

    // True if the crack has cut the tooth, which then carries no load.
    bool broken() const { return broken_; }
    // Added compliance, m/N, for a contact above the crack's start at this angle. Not valid for a
    // broken tooth.
    double added(double contact_angle) const;

  private:
    struct Point {
        double opening_weight, sliding_weight;
        CrackIntensity intensity;
    };
    bool broken_ = false;
    std::vector<Point> points_;
};

}  // namespace gearpod::stiffness
