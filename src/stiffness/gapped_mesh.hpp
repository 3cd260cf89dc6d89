// Gear pair whose tooth pairs have gaps: relief, crowning, and contact that starts before and ends
// after the nominal path of contact (gears/corner_contact.hpp).
//
// Each slice of each tooth pair is a unilateral spring, which carries compression only. A spur pair
// has one slice unless it is crowned. The slices of a helical pair start their engagement one after
// the other (helical_mesh.hpp) and each have a gap. Positions tau count from the start of the
// extended engagement. The total is the secant stiffness under the nominal force, which is the
// force over the approach of the gears, also while a fault passes. Mesh damping is instead
// proportional to the sum of the stiffness on the nominal paths, as without gaps.
//
// Pairs coupled through elastic bodies have the stiffness that they have while all pairs on their
// paths are in contact.
#pragma once

#include <memory>
#include <vector>

#include "gears/flank_relief.hpp"
#include "stiffness/mesh_stiffness.hpp"
#include "stiffness/path_extension.hpp"
#include "stiffness/tooth_pair_curve.hpp"

namespace gearpod::stiffness {

// Flanks of a gear pair, with their relief and the extent of their contact.
struct FlankGaps {
    gears::MeshGeometry geometry;
    gears::FlankRelief relief_1 = {}, relief_2 = {};
    // Corner gap, m, up to which contact outside the nominal path is followed. 0: the pair's
    // stiffness starts and ends abruptly with the nominal path.
    double reach_m = 0;
};

class GappedMesh : public MeshStiffness {
  public:
    // spur: the pair on its nominal path, as wide as the face. overlap_ratio: 0 for spur teeth.
    // force_N: nominal force along the line of action. slices: number across the face, at least 1.
    // Throws std::invalid_argument for invalid values.
    GappedMesh(std::unique_ptr<const MeshStiffness> spur, double overlap_ratio,
               const FlankGaps& gaps, double force_N, int slices);

    // Mesh periods from the first to the last position at which the teeth may touch.
    double contact_ratio() const override { return spur_ratio_ + overlap_; }
    double pitch_position() const override {
        return path_begin() + spur_->pitch_position() + 0.5 * overlap_;
    }
    double path_begin() const override { return extension_.reach().before; }
    double path_end() const override { return contact_ratio() - extension_.reach().after; }
    double flank_position(double tau) const override;
    const MeshStiffness& slice() const override { return *spur_; }
    void total(std::span<const double> tau, double inside,
               std::span<double> stiffness) const override;
    void path_total(std::span<const double> tau, double inside,
                    std::span<double> stiffness) const override;
    void share(std::span<const double> tau, double inside, std::span<double> share) const override;
    std::vector<double> transitions() const override { return transitions_; }
    std::unique_ptr<const FaultyMesh> with_fault(const ToothFault& fault) const override;

    int slices() const override { return slices_; }
    bool has_gaps() const override { return true; }
    void slice_stiffness(int slice, std::span<const double> tau, double inside,
                         std::span<double> stiffness) const override;
    double slice_gap(int slice, double tau) const override;
    double slice_flank_position(int slice, double tau) const override;

  private:
    friend class FaultyGappedMesh;
    // Delay of a slice, mesh periods, and its position across the face, -1 to 1.
    double delay(int slice) const { return overlap_ * (slice + 0.5) / slices_; }
    double across(int slice) const { return (2 * slice + 1.0) / slices_ - 1; }
    // Adds the sum over the slices of weight(slice) times the total of `pairs` on their paths.
    template <class Weight>
    void add_path_total(const NominalPairs& pairs, const Weight& weight,
                        std::span<const double> tau, double inside,
                        std::span<double> stiffness) const;
    // Positions within a tooth pair's engagement, ascending, between which a curve is smooth.
    std::vector<double> breaks() const;
    std::vector<double> make_transitions() const;
    ToothPairCurve fit(ExtendedPairs& pairs, int tooth, const std::vector<double>& breaks) const;

    std::unique_ptr<const MeshStiffness> spur_;
    double overlap_;
    FlankGaps gaps_;
    double force_;
    int slices_;
    PathExtension extension_;
    double spur_ratio_;  // duration of one slice's engagement, mesh periods
    ExtendedPairs::Change joins_, leaves_;
    ToothPairCurve curve_;  // one slice as wide as the face, over its engagement
    std::vector<double> transitions_;
};

}  // namespace gearpod::stiffness
