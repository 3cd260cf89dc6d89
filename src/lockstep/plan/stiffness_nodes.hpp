// Stiffness of all pairs at the stage nodes of a phase grid: one contiguous load per pair and node.
#pragma once

#include <span>
#include <vector>

#include "dynamics/effects/mesh_damping.hpp"
#include "lockstep/plan/phase_grid.hpp"

namespace gearpod::stiffness {
class FaultyMesh;  // stiffness/mesh_stiffness.hpp: kernels, which read tables, know nothing of it
class MeshStiffness;
}  // namespace gearpod::stiffness

namespace gearpod::lockstep {

// A gearbox's gear pairs; of a planetary train sp1..spN, rp1..rpN. Pair i's tooth pairs start
// engaging at the phases start[i] + integer, in mesh periods since sp1 was at its pitch point.
struct PairSet {
    std::vector<const stiffness::MeshStiffness*> mesh;
    std::vector<double> start;  // in [0, 1)
    // The gears turn the other way (in a train: the planets past the carrier; the sun is held, or
    // the ring drives a standing carrier): contact runs the same line of action from its end to its
    // start.
    bool reversed = false;

    int pairs() const { return static_cast<int>(start.size()); }
    const stiffness::MeshStiffness& curve(int pair) const {
        return *mesh[static_cast<std::size_t>(pair)];
    }
    // Phase at which the tooth pair that engages at start[pair] is at its pitch point.
    double pitch_phase(int pair) const;
    // All tooth pairs of a healthy pair at a phase (mesh periods since sp1 was at its pitch point);
    // at a transition the limit from later phases.
    double total(int pair, double phase) const;
};

// The part of a phase within its mesh period, in [0, 1).
double phase_in_period(double phase);

// Phases in [0, 1), ascending, that bound the stretches of all pairs.
std::vector<double> contact_transitions(const PairSet& pairs);

// Steps in which the same tooth pairs of a gear pair touch; the one that begins to engage in the
// same mesh period has age 0, the one before it 1, and so on.
struct ToothEngagement {
    int pair = 0;
    int first_step = 0;
    int last_step = 0;  // one past the last
    int youngest = 0;   // its age; further ones are a period older each
};

// Stiffness and damping shape (dynamics::MeshDamping), [step][stage node][pair].
struct StiffnessNodes {
    int pairs = 0;
    std::vector<double> stiffness;      // N/m
    std::vector<double> damping_shape;  // see effects/mesh_damping.hpp
    // Static transmission error, m, and its rate, m per mesh period; empty: none.
    std::vector<double> error, error_rate;
    // Springs of the tooth pairs and their slices, [step][stage node][tooth pair][slice][pair], the
    // youngest tooth pair first: stiffness in N/m, 0 where fewer are engaged; position on the path
    // of contact, -1/2 to 1/2 from its start to its end in the sense of gears::MeshGeometry, which
    // is its end before and after it; gap that all lanes have, m, empty if there is none. All are
    // empty unless single tooth pairs are needed.
    int tooth_pairs = 0;
    int slices = 1;
    std::vector<double> tooth_stiffness, tooth_place, tooth_gap;
    int contacts() const { return tooth_pairs * slices; }
    std::vector<ToothEngagement> engagements;  // every pair's, in order
};

StiffnessNodes tabulate(const PairSet& pairs, const PhaseGrid& grid, dynamics::MeshDamping damping);

// Consecutive steps of one mesh period and where they lie: mesh periods since something began.
struct StepPositions {
    int first_step = 0;
    int last_step = 0;           // one past the last
    std::vector<double> node;    // [step - first_step][stage node]
    std::vector<double> middle;  // [step - first_step]: decides to which stretch a step belongs
};

// The steps of mesh `mesh` (an integer count of mesh periods) during which something that began at
// phase `start` (not reduced) and lasts `duration` is under way.
StepPositions steps_under_way(const PhaseGrid& grid, double mesh, double start, double duration);

// The total of a healthy pair during these steps, [step - first_step][stage node], N/m; positions
// count from an engagement of its teeth.
std::vector<double> healthy_total(const stiffness::MeshStiffness& mesh, bool reversed,
                                  const StepPositions& steps);
// The same while a fault passes; positions count from the engagement of its first tooth.
std::vector<double> faulty_total(const stiffness::MeshStiffness& healthy,
                                 const stiffness::FaultyMesh& faulty, bool reversed,
                                 const StepPositions& steps);

}  // namespace gearpod::lockstep
