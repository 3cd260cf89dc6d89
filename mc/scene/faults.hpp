// The fault of a study: which pairs the faulty tooth weakens, when, and by how much.
#pragma once

#include <memory>
#include <vector>

#include "lockstep/plan/fault_schedule.hpp"
#include "mc/scene/meshes.hpp"

namespace gearpod::mc {

// A faulty tooth's side: the mesh of meshes_of(kind) in which it acts, and its gear there, 1 or 2.
struct FaultPlace {
    std::size_t mesh;
    int gear;
};
std::vector<FaultPlace> fault_places(const Fault& fault);

class SceneFault {
  public:
    // The meshes must outlive the fault. Throws SceneError.
    SceneFault(const Study& study, const std::vector<SceneMesh>& meshes,
               const lockstep::PairSet& pairs);

    // Empty without a fault.
    const lockstep::FaultPattern& pattern() const { return pattern_; }
    // One for each mesh that the tooth weakens.
    int curves() const { return static_cast<int>(laws_.size()); }
    // A mesh with the faulty tooth of that size; null if it is 0 or there is no fault.
    std::shared_ptr<const stiffness::FaultyMesh> mesh(int curve, double size) const;
    // The size at which the tooth carries nothing, or beyond which it has no meaning.
    double largest_size() const;
    // Phases at which a law jumps whatever the size.
    std::vector<double> jumps(const lockstep::PairSet& pairs) const;

  private:
    struct Law {
        const stiffness::MeshStiffness* mesh;
        std::unique_ptr<const stiffness::ToothFaultFamily> family;
    };
    std::vector<Law> laws_;
    lockstep::FaultPattern pattern_;
};

}  // namespace gearpod::mc
