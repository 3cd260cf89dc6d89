// Mesh stiffness on which mesh damping depends: the sum over the tooth pairs on their nominal paths
// of contact (stiffness::MeshStiffness::path_total).
#pragma once

#include <vector>

#include "lockstep/plan/stiffness_nodes.hpp"

namespace gearpod::lockstep {

// As healthy_total and faulty_total, N/m.
std::vector<double> healthy_path_total(const stiffness::MeshStiffness& mesh, bool reversed,
                                       const StepPositions& steps);
std::vector<double> faulty_path_total(const stiffness::MeshStiffness& healthy,
                                      const stiffness::FaultyMesh& faulty, bool reversed,
                                      const StepPositions& steps);

}  // namespace gearpod::lockstep
