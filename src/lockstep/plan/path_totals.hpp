// Mesh stiffness that mesh damping depends on: the sum over the tooth pairs on their nominal paths
// of contact (stiffness::MeshStiffness::path_total).
#pragma once

#include <vector>

namespace gearpod::stiffness {
class FaultyMesh;
class MeshStiffness;
}  // namespace gearpod::stiffness

namespace gearpod::lockstep {

struct StepPositions;  // defined in lockstep/plan/stiffness_nodes.hpp

// Counterparts of healthy_total and faulty_total for the nominal paths of contact, N/m.
std::vector<double> healthy_path_total(const stiffness::MeshStiffness& mesh, bool reversed,
                                       const StepPositions& steps);
std::vector<double> faulty_path_total(const stiffness::MeshStiffness& healthy,
                                      const stiffness::FaultyMesh& faulty, bool reversed,
                                      const StepPositions& steps);

}  // namespace gearpod::lockstep
