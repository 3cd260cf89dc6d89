// Springs of a helical tooth pair with gaps. The contact line of helical teeth lies on positions
// [tau - e_b, tau] of the spur pair's engagement, where e_b is the overlap ratio
// (helical_mesh.hpp). The engagement is cut where the gap of the spur pair reaches certain
// fractions of the nominal approach d0 of the gears. Each part of the contact line is one spring:
//
//     k = integral of k_spur, k e = integral of k_spur e_spur, both divided by e_b.
//
// Most of the engagement has small gaps and is one part. A part with larger gaps lies on both sides
// of it. One cut is at d0, so that the force and its derivative are exact at d0. Parts depend on
// the engagement, not on the face, because parts of the face would touch one after the other and
// add one wave each to the transmission error. Only the part with small gaps of crowned teeth is
// also divided across the face. Flanks that wear have different gaps within that part, which is
// therefore also divided along the path.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "stiffness/pair_gap.hpp"
#include "stiffness/piecewise_curves.hpp"
#include "stiffness/teeth/tooth_fault.hpp"

namespace gearpod::stiffness {

// Largest number of springs of a gear pair, unless the least number of cuts needs more.
inline constexpr int kMostSlicedSprings = 72;

// Value type; threads may share its const members.
class HelicalSlices {
  public:
    // curve: stiffness of the spur pair as wide as the face over its engagement, N/m. points: from
    // 0 to the end of the engagement, mesh periods, between which stiffness and gap are smooth.
    // across: number of parts across the face. force_N: nominal force along the line of action.
    HelicalSlices(const ToothPairCurve& curve, const std::vector<double>& points,
                  const PairGap& gap, double overlap_ratio, int across, double force_N);

    int count() const { return static_cast<int>(slices_.size()); }
    // Stiffness, N/m, and gap, m, of a slice. Positions tau count from the start of the engagement.
    double stiffness(int slice, double tau) const;
    double gap(int slice, double tau) const;
    // Gap of a slice by wear of unit depth.
    double wear(int slice, double tau) const;
    // Mean position on the flank, weighted by stiffness: -1/2 at the start of the nominal path and
    // before it, 1/2 at its end and beyond.
    double flank_position(int slice, double tau) const;
    // Share of the face at which the slice is on the nominal path.
    double on_path(int slice, double tau) const;
    // Mean over `part` of the face of a curve given by its integral over the engagement, as far as
    // the slice covers that part. The means of all slices add up to that of the part.
    double mean(const RunningIntegral& integral, int slice, double tau,
                const FaceRange& part) const;
    // Phases at which a slice starts or ends to cover the contact line, mesh periods.
    std::vector<double> changes() const;

  private:
    // Positions in the spur pair's engagement.
    struct Positions {
        double begin = 0, end = 0;
        double length() const { return end - begin; }
    };
    struct Slice {
        std::array<Positions, 2> engaged;  // the second one is empty in the part with small gaps
        FaceRange face;
        double least_gap = 0, largest_gap = 0;  // without crowning, m
        double least_wear = 0, largest_wear = 0;
    };
    Positions covered(const Slice& slice, const Positions& engaged, double tau,
                      const FaceRange& part) const;
    double gap_at(double position) const;
    double wear_at(double position) const;
    double flank_position_at(double position) const;
    // Position at which the gap reaches `gap_m`, between one with a smaller gap and an end.
    double reaches(double gap_m, double closest, double end) const;
    void add_slice(const std::array<Positions, 2>& engaged, const FaceRange& face);

    PairGap gap_;
    double ratio_, overlap_;
    std::vector<Slice> slices_;
    std::array<RunningIntegral, 3> stiffness_;  // of the stiffness times position^0, 1, 2
    RunningIntegral force_,
        flank_position_;                   // of the stiffness times gap, and times flank position
    std::optional<RunningIntegral> wear_;  // of the stiffness times wear; empty without wear
};

}  // namespace gearpod::stiffness
