// Fault of a study: which gear pairs the faulty tooth weakens, when, and by how much; or which
// pairs have worn flanks.
#pragma once

#include <memory>
#include <vector>

#include "lockstep/plan/fault_schedule.hpp"
#include "mc/scene/meshes.hpp"

namespace gearpod::mc {

class SceneFault {
  public:
    // Precondition: the meshes outlive the fault. Throws SceneError.
    SceneFault(const Study& study, const std::vector<SceneMesh>& meshes,
               const lockstep::PairSet& pairs);

    // Passages of the faulty tooth; empty without a fault and for wear.
    const lockstep::FaultPattern& pattern() const { return pattern_; }
    // Number of meshes that the tooth weakens, each with its own stiffness curve.
    int curves() const { return static_cast<int>(laws_.size()); }
    // Pairs whose flanks wear; their depth is the fault's size.
    const std::vector<int>& worn_pairs() const { return worn_pairs_; }
    // Mesh with the faulty tooth of that size; null if the size is 0 or there is no fault.
    std::shared_ptr<const stiffness::FaultyMesh> mesh(int curve, double size) const;
    // Size at which the tooth transmits no load, or above which the fault model is undefined; 0 if
    // there is none.
    double largest_size() const;
    // Mesh phases at which a fault's stiffness jumps, whatever its size.
    std::vector<double> jumps(const lockstep::PairSet& pairs) const;

  private:
    struct Law {
        const stiffness::MeshStiffness* mesh;
        std::unique_ptr<const stiffness::ToothFaultFamily> family;
    };
    std::vector<Law> laws_;
    std::vector<int> worn_pairs_;
    lockstep::FaultPattern pattern_;
};

}  // namespace gearpod::mc
