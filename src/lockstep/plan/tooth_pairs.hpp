// Single tooth pairs of gear pairs for unilateral contact: their engagements, their stiffness in
// the healthy state or while a fault passes, and the errors of their teeth.
#pragma once

#include <span>
#include <vector>

#include "gears/planetary.hpp"
#include "lockstep/plan/integration_plan.hpp"
#include "lockstep/plan/stiffness_nodes.hpp"
#include "machine/ids.hpp"

namespace gearpod::lockstep {

// Tooth pairs of `pair` that are engaged at a phase strictly between transitions. The one that
// starts to engage in the mesh period of that phase has age 0, the previous one age 1, and so on.
struct EngagedTeeth {
    int youngest = 0;  // age of the youngest
    int count = 0;     // each further one is a mesh period older
};
EngagedTeeth engaged_teeth(const PairSet& pairs, PairId pair, double phase);

// Adds the springs of the tooth pairs to a table. `worn` lists the pairs whose flanks wear; their
// meshes give the shape (MeshStiffness::slice_wear). Throws std::invalid_argument if more than
// dynamics::kMostToothPairs are engaged at once, or more than kMostContacts of their slices.
void add_tooth_pairs(const PairSet& pairs, const PhaseGrid& grid, StiffnessNodes& nodes,
                     const std::vector<int>& worn = {});

// Passage of a fault through a pair. `start` is the phase at which its first faulty tooth starts to
// engage, in mesh periods from the same origin as mesh period `mesh`.
struct Passage {
    PairId pair;
    int mesh = 0;  // index of the mesh period
    double start = 0.0;
};

// Stiffness of the tooth pairs' slices during these steps of the passage, N/m, [step -
// first_step][stage node][tooth pair][slice]. `tooth_pairs` and `slices` are the sizes of the
// table.
std::vector<double> faulty_tooth_pairs(const PairSet& pairs, const stiffness::FaultyMesh& faulty,
                                       const Passage& passage, const StepPositions& steps,
                                       int tooth_pairs, int slices = 1);

// Errors of single teeth. Each is the gap that a tooth pair would have if the gears turned
// uniformly; it must close before the pair carries load (unilateral contact). The same teeth meet
// again only after many mesh periods, so every mesh period is solved by itself.

// Errors of the teeth of one gear, on one of its flanks, in W realizations. Gaps are positive.
struct GearErrors {
    int teeth = 0;
    machine::AlignedVector error_m;  // [tooth][lane]: index deviations
    // Growth of the gap along the flank from the contact's end near the root to that near the tip,
    // about its middle, m, [tooth][lane]. Empty if there is none.
    machine::AlignedVector slope_m = {};
};

// Both gears of a pair: the index of each, and the mesh period in which its tooth 0 starts to
// engage in this pair. `driver` is the driving gear in the mesh geometry (gears::MeshGeometry):
// contact runs on its teeth from root to tip, and on the other gear's from tip to root.
struct PairTeeth {
    int gear[2] = {};
    int first[2] = {};
    int driver = 0;
};

struct ToothErrors {
    std::vector<GearErrors> gears;
    std::vector<PairTeeth> pairs;

    std::size_t lanes() const {
        return gears.front().error_m.size() / static_cast<std::size_t>(gears.front().teeth);
    }
};

// Teeth that meet in the pairs of a planetary train. Gears: the sun, the ring, then each planet's
// sun side and ring side, 2 + 2N in all. The two sides of a planet are different flanks.
std::vector<PairTeeth> planetary_teeth(const PairSet& pairs, const gears::PlanetaryTrain& train,
                                       gears::PlanetSense sense);
// Teeth that meet in a fixed-shaft pair. Gears: the pinion, the gear.
std::vector<PairTeeth> fixed_shaft_teeth();

// Gaps of the tooth pairs of all pairs in mesh period k, which may be any integer.
std::vector<PairGaps> tooth_gaps(const IntegrationPlan& plan, const ToothErrors& errors, int k);

// Gaps of a pair in a step; null if it has none.
const PairGaps* gaps_of_pair(std::span<const PairGaps> gaps, PairId pair, int step);

// Index of one spring of a pair in the tables of StiffnessNodes; contact = tooth pair * slices +
// slice.
std::size_t tooth_pair_at(const IntegrationPlan& plan, int step, int node, int contact,
                          PairId pair);

// Total gap of that spring at a stage node, m: tooth errors, relief, corner contact, and wear of
// the given depth, m.
double tooth_gap(const IntegrationPlan& plan, std::span<const PairGaps> gaps, PairId pair, int step,
                 int node, int contact, LaneId lane, double wear = 0.0);

}  // namespace gearpod::lockstep
