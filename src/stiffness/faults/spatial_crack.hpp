// Crack whose depth, height and angle vary along the face width, its growth by stages, and the
// compliance of its tooth in slices.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "gears/mesh_geometry.hpp"
#include "stiffness/foundation/fillet_foundation.hpp"
#include "stiffness/teeth/crack.hpp"
#include "stiffness/teeth/fracture_mechanics.hpp"
#include "stiffness/teeth/material.hpp"
#include "stiffness/teeth/tooth_fault.hpp"
#include "stiffness/teeth/tooth_profile.hpp"

namespace gearpod::stiffness {

// Shape and growth of a crack whose depth, height and angle vary along the face width. Source: Yang
// (2022), Eqs. 61-66. The available text lacks signs and roots, so the forms are derived from their
// limits:
//
//     depth    q(z) = q1 sqrt((L_c - z) / L_c)                 partial width: q1 at 0, 0 at L_c
//              q(z) = sqrt((q2^2 - q1^2) z / L + q1^2)         full width: q1 at 0, q2 at L
//     height   l(z) = (l2 - l1) (z / L)^2 + l1
//     angle    g(z) = (g2 - g1) z / L + g1
//
// In both depths z is quadratic in q: a parabola whose axis lies along the width. Without its root
// the first would be a straight line, contrary to the text, and the q1^2 of the second would not be
// a length. The square in the height is printed. Yang's height may also have waves, which are left
// out. One form covers both depths and the growth from one to the other: a parabola from q1 at 0 to
// q2 at L_c, and no crack beyond.

// Shape of a crack along the face width. Lengths in metres. The reference section is the root
// section, or by fracture mechanics the critical one.
struct CrackSurface {
    double depth_m = 0, end_depth_m = 0;      // q1, q2
    double length_m = 0;                      // L_c, along the face width
    double height_m = 0, end_height_m = 0;    // l1, l2, of the start above the reference section
    double angle_rad = 0, end_angle_rad = 0;  // g1, g2
    double face_width_m = 0;                  // L

    bool cracked() const { return length_m > 0 && (depth_m > 0 || end_depth_m > 0); }
    // True if the crack is the same along its whole length.
    bool uniform() const;
    // Functions of the position t along the crack's length, 0 to 1, in which the depth is linear
    // and all other quantities are smooth.
    double z_at(double t) const;        // z
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
    int slices = 16;  // number of slices of the tooth; rounded up to a multiple of eight

    int stages() const { return static_cast<int>(depth_m.size()); }
    // Crack at a stage of growth. Stages above the last are treated as the last.
    CrackSurface at(double stage, double face_width_m) const;
};

// Errors of such a growth in a tooth of the given face width, one sentence each; empty if there are
// none.
std::vector<std::string> growth_problems(const CrackGrowth& growth, double face_width_m);

// Quadrature over the part of a crack's length that affects a contact. Positions t range from 0 to
// 1.

// Gauss points in panels of eight. Integrals may end anywhere in a panel, because the integrand is
// interpolated through the panel's points.
class SliceRule {
  public:
    explicit SliceRule(int slices);
    const std::vector<double>& points() const { return points_; }
    // Writes the weights of the integral over all of [0, 1].
    void whole(std::span<double> weights) const;
    // Writes the weights of the integral over the parts where seen(t) > 0. `seen` is sampled at
    // samples / panels points of every panel, rounded down; of two zeros between neighbouring
    // points none is noticed.
    void where(const std::function<double(double)>& seen, int samples,
               std::span<double> weights) const;

  private:
    void add_part(std::size_t panel, double from, double to, std::span<double> weights) const;

    std::size_t panels_;
    std::vector<double> points_;
};

// Crack whose depth, height and angle vary along the face width. Source: Yang
// (2022), section 2.3.
//
// Each slice of the width has a plane crack (crack.hpp). The bending stiffnesses of the slices add,
// and by sections so do their shear and their foundation stiffnesses (Eqs. 59-60). The axial
// stiffness is the healthy tooth's. The slices are Gauss points of the crack's length, of equal
// depth steps, which converge faster than slices of equal width.
//
// A contact below a slice's start is not affected by that slice's crack. The sum then ends exactly
// where the height of the start passes the contact. A crack of constant height that starts within
// the contact's range makes the stiffness jump there. As that position depends on the size, it is
// one of the fault's breaks but not of its jumps. The error of sixteen slices is 2e-5 of the
// compliance where the whole crack affects the contact, and up to 5e-4 where only part of it does.
//
// Foundation: the part of the crack below the root section narrows the root to S' = S - q_b sin g
// with q_b = q - l / cos g. It thereby increases the ratio of lever to width by the factor S / S'.
// The added foundation compliance is included in that of the beam.
//
// By fracture mechanics (src/stiffness/teeth/fracture_mechanics.hpp) a slice has the whole tooth's
// compliance and, in bending, the compliance that the crack adds in a tooth of that depth
// throughout (src/stiffness/teeth/fracture_mechanics.hpp). This includes the deformation of the
// root, so the foundation is unchanged. Heights are measured from the critical section. The slices
// of tooth, contact and mate are in series and these add along the face; the mate counts as an
// equal healthy tooth. Added in bending alone, slices without a crack would take over the load and
// hide a crack over part of the face: solid finite elements lose up to four times as much.

// Size: stage of growth, from 0 (healthy) to the number of stages.
class SpatialCrack : public ToothFaultFamily {
  public:
    // which: gear with the cracked tooth (1 or 2 of the geometry). foundation: that gear's
    // foundation in the mesh, or null; it must outlive the family. Throws std::invalid_argument
    // with all of growth_problems(), or unless which is 1 or 2.
    SpatialCrack(const gears::MeshGeometry& geometry, const Material& material, Profile profile,
                 int which, CrackGrowth growth, const FilletFoundation* foundation = nullptr,
                 CrackLaw law = CrackLaw::sections);

    std::unique_ptr<const ToothFault> at(double stage) const override;
    double largest_size() const override { return growth_.stages(); }

  private:
    friend class SpatialCrackFault;
    double angle_at(double tau) const { return contact_start_ + contact_rate_ * tau; }
    double position_of(double u) const { return (u - contact_start_) / contact_rate_; }

    ToothProfile profile_;
    Material material_;
    int which_;
    CrackGrowth growth_;
    const FilletFoundation* foundation_;
    CrackLaw law_;
    double contact_ratio_;
    double contact_start_, contact_rate_;  // involute angle of the contact: start + rate tau
};

}  // namespace gearpod::stiffness
