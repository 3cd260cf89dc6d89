// Tooth pairs of gear pairs one by one, for unilateral contact: which are engaged when, and how
// stiff each is, healthy or while a fault passes.
#pragma once

#include <vector>

#include "lockstep/plan/stiffness_nodes.hpp"

namespace gearpod::lockstep {

// Tooth pairs of `pair` that are engaged at a phase strictly between transitions. The one that
// starts its engagement in the mesh period of that phase has age 0, the one before it 1, and so on.
struct TouchingTeeth {
    int youngest = 0;  // its age
    int count = 0;     // further ones are a period older each
};
TouchingTeeth touching_teeth(const PairSet& pairs, int pair, double phase);

// Adds the springs of the tooth pairs to a table. Throws std::invalid_argument where more than
// dynamics::kMostToothPairs are engaged at once, or more than kMostContacts slices of them.
void add_tooth_pairs(const PairSet& pairs, const PhaseGrid& grid, StiffnessNodes& nodes);

// Passage of a fault through a pair: when its first faulty tooth started its engagement, in mesh
// periods from the same origin as mesh k.
struct Passage {
    int pair = 0;
    int mesh = 0;  // k
    double start = 0.0;
};

// Stiffness of the tooth pairs' slices during these steps of the passage, N/m,
// [step - first_step][stage node][tooth pair][slice], for a table of that many of both.
std::vector<double> faulty_tooth_pairs(const PairSet& pairs, const stiffness::FaultyMesh& faulty,
                                       const Passage& passage, const StepPositions& steps,
                                       int tooth_pairs, int slices = 1);

}  // namespace gearpod::lockstep
