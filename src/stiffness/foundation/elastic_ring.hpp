// Compliance of a gear body as an elastic ring, fixed on one circle and loaded on the other.
#pragma once

#include <array>

#include "stiffness/foundation/fillet_foundation.hpp"

namespace gearpod::stiffness {

// Elastic annulus in plane strain, fixed on one circle and loaded on the other, harmonic by
// harmonic (Michell's solution in the form of Kolosov and Muskhelishvili). Lengths are in units of
// the loaded circle's radius, tractions in units of Young's modulus. On the loaded circle the
// tractions
//
//     t_r = T_r cos n phi, t_phi = T_t sin n phi   give   u_r = U cos n phi, u_phi = V sin n phi;
//
// rotated by a quarter of the period, t_r = T_r sin, t_phi = -T_t cos give U sin, -V cos.

// Compliance of one harmonic: U = rr T_r + rt T_t, V = rt T_r + tt T_t, symmetric (Betti). Harmonic
// 0 has rt = 0, and its tt is the twist u_phi under a uniform t_phi.
struct HarmonicCompliance {
    double rr = 0, rt = 0, tt = 0;
};

class Annulus {
  public:
    // held_radius: radius of the fixed circle. Below 1, the loaded circle is the outer one; above
    // 1, the inner one.
    Annulus(double held_radius, double poisson_ratio);

    HarmonicCompliance harmonic(int n) const;
    // Limits of harmonic(n) for large n, with all 1 / (n +- 1) replaced by 1 / n: rr = tt = even /
    // n, rt = odd / n.
    double limit_even() const;
    double limit_odd() const;

  private:
    HarmonicCompliance without_held_circle(int n) const;
    HarmonicCompliance mean() const;

    double held_;
    double shear_;      // G / E
    double kappa_;      // 3 - 4 nu
    double lame_;       // lambda / E
    double outwards_;   // 1: the loaded circle is the outer one; -1: the inner one
    int far_harmonic_;  // from this harmonic on the fixed circle has no effect
};

// Gear body as an elastic ring, fixed on one circle and loaded by the teeth's roots on the other.
// It solves Sainsot's model instead of fitting it, and includes the coupling of neighbouring teeth.
// It replaces the polynomials that Yang (2022) cites for the structure coupling (Xie et al. 2018).
//
// A tooth loads the arc of its root by a uniform shear, a uniform normal and a linear normal
// stress. These are the only stresses of this shape that balance the force in size, line and
// moment. The tooth is rigid. It follows the displacement and rotation of the middle of its own
// root, as in Sainsot's model. It also follows the average of its neighbours' field over its root,
// weighted as the work of its own stresses, which makes the coupling symmetric to rounding.
//
// Plane strain agrees with Sainsot's coefficients. Within the range of his fit the whole compliance
// differs from his by at most 10 % where the root radius is at least twice the bore's. Elsewhere it
// differs by at most 16 % (5 % on average). The part that is quadratic in the lever differs by at
// most 5 %. The rest of the difference is due to the shear stress, which here balances the moment
// about the gear's centre: R_b / (R_f cos a) times his.
//
// An internal gear is fixed at its outer circle. The longer lever of a cracked tooth
// (FoundationCompliance) does not change the shear.
class ElasticRing : public FilletFoundation {
  public:
    // Largest distance, in teeth, at which neighbours are coupled.
    static constexpr int kFarthest = 4;

    // body_radius_m: radius of the circle on which the body is fixed.
    ElasticRing(const ToothProfile& tooth, int teeth, const Material& material,
                double body_radius_m);

    FoundationCompliance self(double contact_angle) const override;
    double coupling(double angle_i, double angle_j, int teeth_apart) const override;

  private:
    enum Stress { shear, linear_normal, normal, kStresses };
    using Stresses = std::array<double, kStresses>;

    // Amplitudes of the three stresses due to a unit force.
    Stresses stresses(double contact_angle) const;
    void add_self_harmonic(int n, const HarmonicCompliance& c);
    void add_self_limits();
    void add_coupling_harmonic(int n, const HarmonicCompliance& c, int teeth);

    double half_angle_;   // half the angle of the root
    double base_radius_;  // base radius over root radius
    double outwards_;     // 1: teeth point outwards; -1: inwards
    double stretch_;      // E L
    double limit_even_, limit_odd_;
    // Displacements at the middle of the root. Shear and linear normal stress cause a displacement
    // along the root and a slope -du_r/dphi; normal stress causes a displacement into the body.
    double displacement_by_shear_ = 0, displacement_by_linear_ = 0;
    double slope_by_shear_ = 0, slope_by_linear_ = 0;
    double displacement_by_normal_ = 0;
    // Work of the row's stress at tooth j on the displacement by the column's stress at tooth i,
    // where j is 1, 2, ... teeth from i in the force's direction.
    std::array<std::array<Stresses, kStresses>, kFarthest> work_{};
};

}  // namespace gearpod::stiffness
