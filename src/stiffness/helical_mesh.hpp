// A pair of helical gears as thin slices of a spur pair: each slice is the transverse section, and
// the next one begins to engage a little later, the last one by the overlap ratio e_b. Slices do
// not lean on each other, so the pair's stiffness is the mean of the spur pair's over the last e_b
// mesh periods:
//
//     k(tau) = 1 / e_b  integral of k_spur(u) du  from tau - e_b to tau,
//
// likewise of one tooth pair. Hence a whole overlap ratio leaves no variation. Of the spur pair:
// its teeth have the stiffness of the helical teeth's slices (Material, set_helix); contact and
// coupling of neighbouring teeth are the slices' own. A fault acts in every slice as it does on the
// spur tooth, so the passage is longer by the overlap ratio. What it takes from the spur tooth it
// takes from those slices alone among which it lies (ToothFault::face, y from 0 to 1 of the width):
//
//     lost(tau) = 1 / (e_b (y_2 - y_1))  integral of lost_spur(u) du  from tau - e_b y_2 to tau -
//     e_b y_1,
//
// as much in all as if it were spread over the width, and the spur tooth's loss for e_b = 0. So the
// rest of the tooth holds up the slices of a pit or a chip as it does on a spur tooth. A chip lies
// on the length that it has at the tip. Sources of the thin slices: Smith, Gear Noise and Vibration
// (2003); Feng et al., Mech. Mach. Theory 128 (2018).
//
// Forces along the axes and tilting stay out: the gears move in the transverse plane.
#pragma once

#include <memory>
#include <vector>

#include "stiffness/mesh_stiffness.hpp"
#include "stiffness/running_integral.hpp"

namespace gearpod::stiffness {

class HelicalMesh : public MeshStiffness {
  public:
    // Throws std::invalid_argument unless overlap_ratio > 0.
    HelicalMesh(std::unique_ptr<const MeshStiffness> spur, double overlap_ratio);

    // Mesh periods from the first slice's engagement to the last one's end.
    double contact_ratio() const override { return spur_->contact_ratio() + overlap_; }
    // Of the slice in the middle.
    double pitch_position() const override { return spur_->pitch_position() + 0.5 * overlap_; }
    double flank_place(double tau) const override;
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
    double tolerance_;  // of the integrated curves, N/m
    std::vector<double> transitions_;
    RunningIntegral period_;  // of the spur pair's total over a mesh period
    RunningIntegral pair_;    // of one of its tooth pairs over its engagement
};

}  // namespace gearpod::stiffness
