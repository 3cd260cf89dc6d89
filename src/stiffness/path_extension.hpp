// Stiffness of spur tooth pairs before and after their nominal path of contact.
//
// Outside the path a tooth pair touches at a tip corner (gears/corner_contact.hpp) and keeps the
// stiffness that it has at that end of the path. Where pairs share elastic gear bodies, a pair that
// joins n others adds K_(n+1) - K_n to the mesh once its gap is closed. On the path all n + 1 pairs
// have their joint stiffness. Both descriptions give the same force where the pair touches. A
// weight blends them during that contact, so that no stiffness jumps at the ends of the path.
#pragma once

#include <map>
#include <span>
#include <utility>

#include "gears/corner_contact.hpp"

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
        double own = 0, added = 0;
        std::map<int, double> others;
        double stiffness(double weight) const { return added + weight * (own - added); }
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

}  // namespace gearpod::stiffness
