// The tooth pairs of gear pairs one by one, for the mesh law `pushing`: which touch when, and how
// stiff each is, healthy or while a fault passes.
#pragma once

#include <vector>

#include "lockstep/plan/stiffness_nodes.hpp"

namespace gearpod::lockstep {

// The tooth pairs of `pair` that touch at a phase strictly between transitions. The one that begins
// to engage in the mesh period of that phase has age 0, the one before it 1, and so on.
struct TouchingTeeth {
    int youngest = 0;  // its age
    int count = 0;     // further ones are a period older each
};
TouchingTeeth touching_teeth(const PairSet& pairs, int pair, double phase);

// Where along the line of action a tooth pair stands, `since` mesh periods after it began to
// engage: -1/2 to 1/2 from the start to the end of contact in the sense of MeshGeometry.
double engagement_place(const PairSet& pairs, int pair, double since);

// Adds the columns of the tooth pairs: each carries its share of its pair's total. Throws
// std::invalid_argument where more than dynamics::kMostToothPairs touch at once.
void add_tooth_pairs(const PairSet& pairs, const PhaseGrid& grid, StiffnessNodes& nodes);

// A fault's passage through a pair: when its first faulty tooth began to engage, in mesh periods
// from the same origin as mesh k.
struct Passage {
    int pair = 0;
    int mesh = 0;  // k
    double start = 0.0;
};

// The tooth pairs' stiffness during these steps of the passage, N/m,
// [step - first_step][stage node][tooth pair], `tooth_pairs` of them.
std::vector<double> faulty_tooth_pairs(const PairSet& pairs, const stiffness::FaultyMesh& faulty,
                                       const Passage& passage, const StepPositions& steps,
                                       int tooth_pairs);

}  // namespace gearpod::lockstep
