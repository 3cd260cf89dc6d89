// Gear pair whose tooth pairs have gaps: relief, crowning, wear, and contact that starts before and
// ends after the nominal path of contact (gears/flank_gaps.hpp). Wear differs between
// gearboxes, so the mesh gives only its distribution over the flank (slice_wear).
//
// Each slice of each tooth pair is a unilateral spring, which carries compression only. A spur pair
// has one slice unless it is crowned. The slices of a helical pair are parts of its contact line
// with similar gaps (helical_slices.hpp). Positions tau count from the start of the extended
// engagement. The total is the secant stiffness under the nominal force, which is the force over
// the approach of the gears, also while a fault passes. Mesh damping is instead proportional to the
// sum of the stiffness on the nominal paths, as without gaps.
//
// Pairs coupled through elastic bodies have the stiffness that they have while all pairs on their
// paths are in contact.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "stiffness/helical_slices.hpp"
#include "stiffness/mesh_stiffness.hpp"
#include "stiffness/pair_gap.hpp"
#include "stiffness/piecewise_curves.hpp"

namespace gearpod::stiffness {

class GappedMesh : public MeshStiffness {
  public:
    // spur: the pair on its nominal path, as wide as the face. overlap_ratio: 0 for spur teeth.
    // force_N: nominal force along the line of action. slices: number across the face, at least 1;
    // helical teeth are also divided along the path.
    // Throws std::invalid_argument for invalid values.
    GappedMesh(std::unique_ptr<const MeshStiffness> spur, double overlap_ratio,
               const FlankGaps& gaps, double force_N, int slices);

    // Mesh periods from the first to the last position at which the teeth may touch.
    double contact_ratio() const override { return spur_ratio_ + overlap_; }
    double pitch_position() const override {
        return path_begin() + spur_.pitch_position() + 0.5 * overlap_;
    }
    double path_begin() const override { return gap_.extension.reach().before; }
    double path_end() const override { return contact_ratio() - gap_.extension.reach().after; }
    double flank_position(double tau) const override;
    const MeshStiffness& slice() const override { return spur_; }
    void total(std::span<const double> tau, double inside,
               std::span<double> stiffness) const override;
    void path_total(std::span<const double> tau, double inside,
                    std::span<double> stiffness) const override;
    void share(std::span<const double> tau, double inside, std::span<double> share) const override;
    std::vector<double> transitions() const override { return transitions_; }
    std::unique_ptr<const FaultyMesh> with_fault(const ToothFault& fault) const override;

    int slices() const override { return helical_slices_ ? helical_slices_->count() : slices_; }
    bool has_gaps() const override { return true; }
    void slice_stiffness(int slice, std::span<const double> tau, double inside,
                         std::span<double> stiffness) const override;
    double slice_gap(int slice, double tau) const override;
    double slice_wear(int slice, double tau) const override;
    double slice_flank_position(int slice, double tau) const override;
    double slice_on_path(int slice, double tau) const override;

  private:
    friend class FaultyGappedMesh;
    bool helical() const { return helical_slices_.has_value(); }
    // Positions within a tooth pair's engagement, ascending, between which a curve is smooth.
    std::vector<double> breaks() const;
    // Positions on the nominal path, from its start, at which the gap has a kink.
    std::vector<double> gap_kinks() const;
    std::vector<double> make_transitions() const;
    ToothPairCurve fit(ExtendedPairs& pairs, int tooth, const std::vector<double>& breaks) const;

    std::unique_ptr<const MeshStiffness> nominal_;  // the gear pair without gaps
    const MeshStiffness& spur_;
    double overlap_;
    double force_;
    int slices_;
    PairGap gap_;
    double spur_ratio_;     // duration of the spur pair's engagement, mesh periods
    ToothPairCurve curve_;  // the spur pair, as wide as the face, over its engagement
    std::optional<HelicalSlices> helical_slices_;  // helical teeth only
    std::vector<double> transitions_;
};

}  // namespace gearpod::stiffness
