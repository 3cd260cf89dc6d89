// Gear pairs of a gearbox, and their stiffness and error at the stage nodes of a phase grid, stored
// so that each pair and node needs one contiguous load.
#pragma once

#include <span>
#include <vector>

#include "dynamics/effects/mesh_damping.hpp"
#include "lockstep/plan/phase_grid.hpp"
#include "machine/ids.hpp"

namespace gearpod::stiffness {
class FaultyMesh;  // defined in stiffness/mesh_stiffness.hpp, which kernels do not include
class MeshStiffness;
}  // namespace gearpod::stiffness

namespace gearpod::lockstep {

// Gear pairs of a gearbox; sp1..spN, rp1..rpN for a planetary train. The tooth pairs of pair i
// start to engage at the phases start[i] + integer, in mesh periods since sp1 was at its pitch
// point.
struct PairSet {
    std::vector<const stiffness::MeshStiffness*> mesh;
    std::vector<double> start;  // in [0, 1)
    // True if the gears turn in the opposite sense, so that contact runs along the same line of
    // action from its end to its start. In a planetary train: the planets relative to the carrier,
    // when the sun is fixed or the ring drives a fixed carrier.
    bool reversed = false;

    int pairs() const { return static_cast<int>(start.size()); }
    const stiffness::MeshStiffness& curve(PairId pair) const { return *mesh[pair]; }
    // Phase at which the tooth pair that engages at start[pair] passes its pitch point.
    double pitch_phase(PairId pair) const;
    // Total stiffness of a healthy pair at a phase (mesh periods since sp1 was at its pitch point).
    // At a transition, the limit from later phases.
    double total(PairId pair, double phase) const;
};

// Fractional part of a phase, in [0, 1).
double phase_in_period(double phase);

// Phases in [0, 1), ascending, of all contact transitions of all pairs.
std::vector<double> contact_transitions(const PairSet& pairs);

// Steps in which the same tooth pairs of a gear pair are engaged. A tooth pair that starts to
// engage in the current mesh period has age 0, the previous one age 1, and so on.
struct ToothEngagement {
    PairId pair;
    int first_step = 0;
    int last_step = 0;  // one past the last
    int youngest = 0;   // age of the youngest tooth pair; each further one is a mesh period older
};

// Stiffness and damping shape (dynamics::MeshDamping), [step][stage node][pair].
struct StiffnessNodes {
    int pairs = 0;
    std::vector<double> stiffness;      // N/m
    std::vector<double> damping_shape;  // see effects/mesh_damping.hpp
    // Static transmission error, m, and its rate, m per mesh period; empty if there is none.
    std::vector<double> error, error_rate;
    // Springs of the tooth pairs' slices, [step][stage node][tooth pair][slice][pair], youngest
    // tooth pair first. All are empty unless the mesh law needs single tooth pairs.
    // - tooth_stiffness: N/m, 0 where fewer tooth pairs are engaged.
    // - tooth_position: position on the path of contact, -1/2 at its start to 1/2 at its end in the
    //   sense of gears::MeshGeometry, clamped outside.
    // - tooth_gap: gap common to all lanes, m; empty if there is none.
    // - tooth_on_path: share of the slice's face on the nominal path; empty if there are no gaps.
    // - tooth_wear: gap by wear of unit depth, 0 in pairs whose flanks do not wear; empty if there
    //   are no others.
    int tooth_pairs = 0;
    int slices = 1;
    std::vector<double> tooth_stiffness, tooth_position, tooth_gap, tooth_on_path, tooth_wear;
    int contacts() const { return tooth_pairs * slices; }
    std::vector<ToothEngagement> engagements;  // of all pairs, in order
};

StiffnessNodes tabulate(const PairSet& pairs, const PhaseGrid& grid, dynamics::MeshDamping damping);

// Consecutive steps of one mesh period and their positions, in mesh periods since an event.
struct StepPositions {
    int first_step = 0;
    int last_step = 0;           // one past the last
    std::vector<double> node;    // [step - first_step][stage node]
    std::vector<double> middle;  // [step - first_step]; selects the stretch that a step belongs to
};

// Steps of mesh period `mesh` (an integer count) that overlap an event that starts at phase `start`
// (not reduced to one period) and lasts `duration`.
StepPositions overlapping_steps(const PhaseGrid& grid, double mesh, double start, double duration);

// Total stiffness of a pair during such steps, [step - first_step][stage node], N/m.
struct PairTotals {
    std::vector<double> all;
    // Sum over the tooth pairs on their nominal paths (stiffness::MeshStiffness::path_total), which
    // mesh damping depends on.
    std::vector<double> paths;
};
// Positions count from an engagement of the healthy pair's teeth.
PairTotals healthy_totals(const stiffness::MeshStiffness& mesh, bool reversed,
                          const StepPositions& steps);
// Same while a fault passes. Positions count from the engagement of the first faulty tooth.
PairTotals faulty_totals(const stiffness::MeshStiffness& healthy,
                         const stiffness::FaultyMesh& faulty, bool reversed,
                         const StepPositions& steps);

// Static transmission error of gear pairs: deviation of the unloaded flanks from the ideal ones,
// expressed as a gap along the line of action (dynamics/effects/mesh_law.hpp).

// Transmission error that repeats every mesh period,
//     e(x) = sum over h >= 1 of amplitude[h-1] sin(2 pi h x + phase[h-1]),
// with x in mesh periods since the pair was at its pitch point. It therefore shifts with the pair's
// mesh phase and runs backwards in reversed contact. Missing phases are 0.
struct MeshError {
    std::vector<double> amplitude_m;
    std::vector<double> phase_rad;
};

// Error, m, and its rate, m per mesh period.
struct ErrorValue {
    double error = 0.0, rate = 0.0;
};
ErrorValue error_at(const MeshError& error, double x);

// Adds the errors of all pairs (one entry per pair) to the table.
void add_errors(const PairSet& pairs, const PhaseGrid& grid, std::span<const MeshError> errors,
                StiffnessNodes& nodes);

}  // namespace gearpod::lockstep
