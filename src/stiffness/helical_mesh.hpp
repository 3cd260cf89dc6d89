// Pair of helical gears modelled as thin slices of a spur pair. Each slice is the transverse
// section. The slices engage one after the other, the last one later than the first by the overlap
// ratio e_b. They do not support each other, so the pair's stiffness is the mean of the spur pair's
// over the last e_b mesh periods:
//
//     k(tau) = 1 / e_b  integral of k_spur(u) du  from tau - e_b to tau,
//
// and likewise for one tooth pair. An integer overlap ratio therefore leaves no variation. The
// teeth of the spur pair have the stiffness of the helical teeth's slices (Material, set_helix).
// Contact and coupling of neighbouring teeth are computed per slice.
//
// A fault acts in every slice as on the spur tooth, so the passage is longer by the overlap ratio.
// The stiffness lost by the spur tooth is lost by the slices within the fault (ToothFault::face, y
// from 0 to 1 of the width):
//
//     lost(tau) = 1 / (e_b (y_2 - y_1))
//                 integral of lost_spur(u) du  from tau - e_b y_2 to tau - e_b y_1.
//
// The total loss is the same as if it were distributed over the width, and equals the spur tooth's
// loss for e_b = 0. The slices of a pit or a chip are thus supported by the rest of the tooth, as
// on a spur tooth. A chip extends over its length at the tip. Sources of the thin-slice model:
// Smith, Gear Noise and Vibration (2003); Feng et al., Mech. Mach. Theory 128 (2018).
//
// Axial forces and tilting are omitted: the gears move in the transverse plane.
#pragma once

#include <memory>
#include <vector>

#include "stiffness/mesh_stiffness.hpp"
#include "stiffness/piecewise_curves.hpp"

namespace gearpod::stiffness {

class HelicalMesh : public MeshStiffness {
  public:
    // Throws std::invalid_argument unless overlap_ratio > 0.
    HelicalMesh(std::unique_ptr<const MeshStiffness> spur, double overlap_ratio);

    // Mesh periods from the first slice's engagement to the last one's end.
    double contact_ratio() const override { return spur_->contact_ratio() + overlap_; }
    // Pitch position of the middle slice.
    double pitch_position() const override { return spur_->pitch_position() + 0.5 * overlap_; }
    double flank_position(double tau) const override;
    void total(std::span<const double> tau, double inside,
               std::span<double> stiffness) const override;
    void share(std::span<const double> tau, double inside, std::span<double> share) const override;
    std::vector<double> transitions() const override { return transitions_; }
    std::unique_ptr<const FaultyMesh> with_fault(const ToothFault& fault) const override;

    const MeshStiffness& slice() const override { return *spur_; }

  private:
    friend class FaultyHelicalMesh;

    void one_pair(std::span<const double> tau, std::span<double> stiffness) const;

    std::unique_ptr<const MeshStiffness> spur_;
    double overlap_;
    double tolerance_;  // absolute error of the integrated curves, N/m
    std::vector<double> transitions_;
    RunningIntegral period_;  // spur pair's total over a mesh period
    RunningIntegral pair_;    // one of its tooth pairs over its engagement
};

}  // namespace gearpod::stiffness
