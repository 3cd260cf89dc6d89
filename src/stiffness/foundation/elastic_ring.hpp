// The gear body as an elastic ring held on one circle and loaded by the teeth's roots on the other:
// Sainsot's model solved instead of fitted, with what it says about neighbouring teeth. It takes
// the place of the polynomials that Yang (2022) cites for the structure coupling (Xie et al. 2018).
//
// A tooth loads the arc of its root by a uniform shear, a uniform normal and a linear normal
// stress, the only ones of this shape that balance the force in size, line and moment. The tooth is
// rigid here: it follows the displacement and the rotation of the middle of its own root, as
// Sainsot's does, and the average over its root (weighted as the work of its own stresses) of its
// neighbours' field, which makes the coupling symmetric to rounding. Plane strain, with which
// Sainsot's coefficients agree: within his range the whole compliance lies within 10 % of his where
// the root radius is twice the bore's or more, within 16 % where it is less (5 % on average), and
// the part that grows with the lever's square within 5 %. The rest of the difference is the shear
// stress, which here balances the moment about the gear's centre: R_b / (R_f cos a) times his. An
// internal gear is held at its outer circle. A crack's longer lever (FoundationCompliance) leaves
// the shear as it is.
#pragma once

#include <array>

#include "stiffness/foundation/annulus.hpp"
#include "stiffness/foundation/fillet_foundation.hpp"

namespace gearpod::stiffness {

class ElasticRing : public FilletFoundation {
  public:
    // Neighbours farther apart than this count as uncoupled.
    static constexpr int kFarthest = 4;

    // body_radius_m: of the circle on which the body is held.
    ElasticRing(const ToothProfile& tooth, int teeth, const Material& material,
                double body_radius_m);

    FoundationCompliance self(double contact_angle) const override;
    double coupling(double angle_i, double angle_j, int teeth_apart) const override;

  private:
    enum Stress { shear, linear_normal, normal, kStresses };
    using Stresses = std::array<double, kStresses>;

    // The amplitudes of the three stresses of a unit force.
    Stresses stresses(double contact_angle) const;
    void add_self_harmonic(int n, const HarmonicCompliance& c);
    void add_self_limits();
    void add_coupling_harmonic(int n, const HarmonicCompliance& c, int teeth);

    double half_angle_;   // of the root
    double base_radius_;  // over the root's
    double outwards_;     // 1: teeth point outwards; -1: inwards
    double stretch_;      // E L
    double limit_even_, limit_odd_;
    // At the middle of the root: by shear and linear normal stress, displacement along the root and
    // slope -du_r/dphi; by normal stress, displacement into the body.
    double moved_by_shear_ = 0, moved_by_linear_ = 0;
    double turned_by_shear_ = 0, turned_by_linear_ = 0;
    double pressed_by_normal_ = 0;
    // Work of row's stress at tooth j on the displacement by column's stress at tooth i, j being 1,
    // 2, ... teeth from i in the force's direction.
    std::array<std::array<Stresses, kStresses>, kFarthest> work_{};
};

}  // namespace gearpod::stiffness
