// Gear pair whose stiffness has two levels: high while two tooth pairs touch, low while one does.
// Source: Park et al. (2016), section III-A, Fig. 3. With equal levels the mesh is constant.
//
// Only the levels are known, so a fault reduces them:
// - A fault of the mesh (Reduction) multiplies both levels while its tooth is engaged. Park,
//   section V-A, gives 10, 20 and 30 % decreases of the gear mesh stiffness, and the faulty tooth
//   smaller magnitudes in its time-varying profile. The paper does not give their duration; the
//   tooth is assumed weak for as long as it is in contact.
// - A fault of the tooth pair (BrokenTooth) removes the stiffness that the pair adds: the low level
//   where it touches alone, the difference of the levels where another pair is in contact.
//
// A fault of sections or contact is rejected, because the model has neither.
#pragma once

#include <optional>

#include "stiffness/mesh_stiffness.hpp"

namespace gearpod::stiffness {

class SquareWaveMesh : public MeshStiffness {
  public:
    // 1 <= contact_ratio <= 2; stiffness in N/m, 0 < low <= high. pitch_position: half the contact
    // ratio by default, not checked. Throws std::invalid_argument for other levels and ratios.
    SquareWaveMesh(double low_N_m, double high_N_m, double contact_ratio,
                   std::optional<double> pitch_position = {});
    static SquareWaveMesh constant(double stiffness_N_m) {
        return {stiffness_N_m, stiffness_N_m, 1.0};
    }

    double contact_ratio() const override { return contact_ratio_; }
    double pitch_position() const override { return pitch_position_; }
    void total(std::span<const double> tau, double inside,
               std::span<double> stiffness) const override;
    // Pairs in contact at the same time carry equal loads.
    void share(std::span<const double> tau, double inside, std::span<double> share) const override;
    std::vector<double> transitions() const override;
    std::unique_ptr<const FaultyMesh> with_fault(const ToothFault& fault) const override;

    // Stiffness of 0, 1 or 2 tooth pairs together.
    double level(int pairs) const { return levels_[pairs]; }

  private:
    double levels_[3];
    double contact_ratio_, pitch_position_;
};

}  // namespace gearpod::stiffness
