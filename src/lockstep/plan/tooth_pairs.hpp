// Single tooth pairs of gear pairs for unilateral contact: their engagements, and their stiffness
// in the healthy state or while a fault passes.
#pragma once

#include <vector>

#include "lockstep/plan/stiffness_nodes.hpp"

namespace gearpod::lockstep {

// Tooth pairs of `pair` that are engaged at a phase strictly between transitions. The one that
// starts to engage in the mesh period of that phase has age 0, the previous one age 1, and so on.
struct EngagedTeeth {
    int youngest = 0;  // age of the youngest
    int count = 0;     // each further one is a mesh period older
};
EngagedTeeth engaged_teeth(const PairSet& pairs, int pair, double phase);

// Adds the springs of the tooth pairs to a table. `worn` lists the pairs whose flanks wear; their
// meshes give the shape (MeshStiffness::slice_wear). Throws std::invalid_argument if more than
// dynamics::kMostToothPairs are engaged at once, or more than kMostContacts of their slices.
void add_tooth_pairs(const PairSet& pairs, const PhaseGrid& grid, StiffnessNodes& nodes,
                     const std::vector<int>& worn = {});

// Passage of a fault through a pair. `start` is the phase at which its first faulty tooth starts to
// engage, in mesh periods from the same origin as mesh period `mesh`.
struct Passage {
    int pair = 0;
    int mesh = 0;  // index of the mesh period
    double start = 0.0;
};

// Stiffness of the tooth pairs' slices during these steps of the passage, N/m, [step -
// first_step][stage node][tooth pair][slice]. `tooth_pairs` and `slices` are the sizes of the
// table.
std::vector<double> faulty_tooth_pairs(const PairSet& pairs, const stiffness::FaultyMesh& faulty,
                                       const Passage& passage, const StepPositions& steps,
                                       int tooth_pairs, int slices = 1);

}  // namespace gearpod::lockstep
