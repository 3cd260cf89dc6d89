// Stiffness of spur tooth pairs before and after their nominal path of contact.
//
// Outside the path a tooth pair touches at a tip corner (gears/flank_gaps.hpp) and keeps the
// stiffness that it has at that end of the path. Where pairs share elastic gear bodies, a pair that
// joins n others adds K_(n+1) - K_n to the mesh once its gap is closed. On the path all n + 1 pairs
// have their joint stiffness. Both descriptions give the same force where the pair touches. A
// weight blends them during that contact, so that no stiffness jumps at the ends of the path.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "gears/flank_gaps.hpp"

namespace gearpod::stiffness {

class FaultyMesh;
class MeshStiffness;

// Spur gear pair on its nominal path of contact, healthy or with a faulty tooth. Positions tau
// count mesh periods from the start of tooth pair 0's path; tooth pair i starts i periods later.
// Both functions take ascending positions in the stretch of `inside` and write N/m.
class NominalPairs {
  public:
    // `faulty`: the pair while a faulty tooth passes, or null. The arguments must outlive the
    // object.
    explicit NominalPairs(const MeshStiffness& spur, const FaultyMesh* faulty = nullptr)
        : spur_(spur), faulty_(faulty) {}
    void total(std::span<const double> tau, double inside, std::span<double> stiffness) const;
    void pair(int tooth, std::span<const double> tau, double inside,
              std::span<double> stiffness) const;

  private:
    bool fault_passes(double inside) const;

    const MeshStiffness& spur_;
    const FaultyMesh* faulty_;
};

// Extent of engagements outside the path, and the weight of the joint stiffness of all pairs in
// contact.
class PathExtension {
  public:
    // No engagement outside the path.
    explicit PathExtension(const gears::MeshGeometry& geometry) : geometry_(geometry) {}
    // Engagement up to corner gaps of reach_m. The weight falls from 1 at the ends of the path to 0
    // where the corner gap is approach_m, the nominal approach of the gears.
    PathExtension(const gears::MeshGeometry& geometry, double reach_m, double approach_m)
        : geometry_(geometry),
          reach_(gears::corner_reach(geometry, reach_m)),
          fade_(gears::corner_reach(geometry, approach_m)),
          approach_(approach_m) {}

    double contact_ratio() const { return geometry_.contact_ratio(); }
    // Mesh periods before and after the path: of the engagement, and of the range where the weight
    // is positive.
    const gears::CornerReach& reach() const { return reach_; }
    const gears::CornerReach& fade() const { return fade_; }
    // Weight at a position measured from the start of a pair's own path; 1 on the path.
    double weight(double tau) const;

  private:
    gears::MeshGeometry geometry_;
    gears::CornerReach reach_, fade_;
    double approach_ = 0;
};

class ExtendedPairs {
  public:
    // The extension must outlive the object.
    ExtendedPairs(const NominalPairs& pairs, const PathExtension& extension)
        : pairs_(pairs), extension_(extension) {}

    // Stiffness of a tooth pair within its extended engagement, N/m, at ascending positions of one
    // smooth piece (between starts and ends of paths and of fades).
    void stiffness(int tooth, std::span<const double> tau, std::span<double> values);

    // Change of the mesh where a tooth pair starts (joins) or ends (leaves) its path: the pair's
    // stiffness among the others, the stiffness it adds to the mesh, and the factors by which it
    // changes the other pairs' stiffness.
    struct Change {
        double pair = 0, added = 0;
        std::map<int, double> others;
        double stiffness(double weight) const { return added + weight * (pair - added); }
    };
    const Change& change(int tooth, bool joins);

  private:
    Change make_change(int tooth, bool joins) const;
    double pair_at(int tooth, double tau, double inside) const;
    double total_at(double tau, double inside) const;
    void apply(int tooth, int other, bool joins, std::span<const double> tau,
               std::span<double> values);

    const NominalPairs pairs_;
    const PathExtension& extension_;
    std::map<std::pair<int, bool>, Change> changes_;
};

// Gap of a spur tooth pair along its engagement: relief, crowning, corner contact and wear.

// Flanks of a gear pair, with their relief and the extent of their contact.
struct FlankGaps {
    gears::MeshGeometry geometry;
    gears::FlankRelief relief_1 = {}, relief_2 = {};
    // Corner gap, m, up to which contact outside the nominal path is followed. 0: contact starts
    // and ends with the nominal path.
    double reach_m = 0;
    std::optional<gears::FlankWear> wear = {};  // empty unless the flanks of a gear wear
    // Sum of the crowning of both flanks, m.
    double crowning_m() const { return relief_1.crowning_m + relief_2.crowning_m; }
    // Gap by crowning, averaged over a slice, m.
    double crown_m(int slice, int slices) const {
        const double middle = (2 * slice + 1.0) / slices - 1, half = 1.0 / slices;  // face: -1 to 1
        return crowning_m() * (middle * middle + half * half / 3);
    }
};

// Outside the path of contact, the stiffness k of the pair's curve differs from `own`, the
// stiffness of the pair among all engaged pairs. The gap is scaled by own / k there, so that the
// product of stiffness and gap is correct.
struct PairGap {
    FlankGaps flanks;
    PathExtension extension;
    ExtendedPairs::Change joins = {}, leaves = {};

    // Position on the flank: -1/2 up to the start of the nominal path, 1/2 from its end on. `at`:
    // mesh periods from the start of the path.
    double flank_position(double position) const {
        return std::clamp(position / extension.contact_ratio(), 0.0, 1.0) - 0.5;
    }
    // Gap, m, at a position from the start of the nominal path, mesh periods; `crown`: gap by
    // crowning, m.
    double operator()(double position, double crown) const {
        const double flank =
            gears::relief_gap(flanks.geometry, flanks.relief_1, flanks.relief_2,
                              std::clamp(position, 0.0, extension.contact_ratio())) +
            crown;
        return on_path(position)
                   ? flank
                   : (flank + gears::corner_gap(flanks.geometry, position)) * scale(position);
    }
    // Gap by wear of unit depth at that position; 0 unless the flanks wear.
    double wear(double position) const {
        return !flanks.wear        ? 0
               : on_path(position) ? flanks.wear->shape(position)
                                   : flanks.wear->shape(position) * scale(position);
    }

  private:
    bool on_path(double position) const {
        return position >= 0 && position <= extension.contact_ratio();
    }
    // Factor of gaps at a position outside of the path.
    double scale(double position) const {
        const ExtendedPairs::Change& end = position < 0 ? joins : leaves;
        const double k = end.stiffness(extension.weight(position));
        return k > 0 ? end.pair / k : 1;
    }
};

}  // namespace gearpod::stiffness
