// Fault of a study: which gear pairs the faulty tooth weakens, when, and by how much.
#pragma once

#include <memory>
#include <vector>

#include "lockstep/plan/fault_schedule.hpp"
#include "mc/scene/meshes.hpp"

namespace gearpod::mc {

// Mesh of meshes_of(kind) in which the faulty tooth acts, and its gear in that mesh, 1 or 2.
struct FaultPlace {
    std::size_t mesh;
    int gear;
};
std::vector<FaultPlace> fault_places(const Fault& fault);

class SceneFault {
  public:
    // Precondition: the meshes outlive the fault. Throws SceneError.
    SceneFault(const Study& study, const std::vector<SceneMesh>& meshes,
               const lockstep::PairSet& pairs);

    // Passages of the faulty tooth; empty without a fault.
    const lockstep::FaultPattern& pattern() const { return pattern_; }
    // Number of meshes that the tooth weakens, each with its own stiffness curve.
    int curves() const { return static_cast<int>(laws_.size()); }
    // Mesh with the faulty tooth of that size; null if the size is 0 or there is no fault.
    std::shared_ptr<const stiffness::FaultyMesh> mesh(int curve, double size) const;
    // Size at which the tooth transmits no load, or above which the fault model is undefined.
    double largest_size() const;
    // Mesh phases at which a fault's stiffness jumps, whatever its size.
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
