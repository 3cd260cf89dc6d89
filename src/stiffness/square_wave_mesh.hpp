// A gear pair whose stiffness has two levels: high while two tooth pairs touch, low while one does.
// Source: Park et al. (2016), section III-A, Fig. 3. With both levels alike the mesh is constant.
//
// The levels are all that is known, so a fault acts by what it takes from them:
// - a fault of the mesh (Reduction) multiplies both levels from the moment its tooth engages until
//   it leaves. Park, section V-A, speaks of 10, 20 and 30 % decreases of the gear mesh stiffness
//   and parameterises the faulty tooth by smaller magnitudes in its time-varying profile; how long
//   they are smaller his text does not say, and a tooth is weak as long as it is touched.
// - a fault of the tooth pair (BrokenTooth) takes what that pair adds: the low level where it
//   touches alone, the difference of the levels where another one carries on.
// A fault of sections or contact is refused: there are no sections and no contact here.
#pragma once

#include <optional>

#include "stiffness/mesh_stiffness.hpp"

namespace gearpod::stiffness {

class SquareWaveMesh : public MeshStiffness {
  public:
    // 1 <= contact_ratio <= 2; stiffness in N/m, 0 < low <= high. pitch_position: half the contact
    // ratio unless given. Throws std::invalid_argument.
    SquareWaveMesh(double low_N_m, double high_N_m, double contact_ratio,
                   std::optional<double> pitch_position = {});
    // One stiffness at all times.
    static SquareWaveMesh constant(double stiffness_N_m) {
        return {stiffness_N_m, stiffness_N_m, 1.0};
    }

    double contact_ratio() const override { return contact_ratio_; }
    double pitch_position() const override { return pitch_position_; }
    void total(std::span<const double> tau, double inside,
               std::span<double> stiffness) const override;
    // Pairs that touch together carry the same.
    void share(std::span<const double> tau, double inside, std::span<double> share) const override;
    std::vector<double> transitions() const override;
    std::unique_ptr<const FaultyMesh> with_fault(const ToothFault& fault) const override;

    // The stiffness of so many tooth pairs together: 0, 1 or 2.
    double level(int pairs) const { return levels_[pairs]; }

  private:
    double levels_[3];
    double contact_ratio_, pitch_position_;
};

}  // namespace gearpod::stiffness
