// Errors of single teeth. Each is the gap that a tooth pair would have if the gears turned
// uniformly; it must close before the pair carries load (unilateral contact). The same teeth meet
// again only after many mesh periods, so every mesh period is solved by itself.
#pragma once

#include <span>
#include <vector>

#include "gears/planetary.hpp"
#include "lockstep/plan/integration_plan.hpp"

namespace gearpod::lockstep {

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
const PairGaps* gaps_of_pair(std::span<const PairGaps> gaps, int pair, int step);

// Index of one spring of a pair in the tables of StiffnessNodes; contact = tooth pair * slices +
// slice.
std::size_t tooth_pair_at(const IntegrationPlan& plan, int step, int node, int contact, int pair);

// Total gap of that spring at a stage node, m: tooth errors, relief, corner contact, and wear of
// the given depth, m.
double tooth_gap(const IntegrationPlan& plan, std::span<const PairGaps> gaps, int pair, int step,
                 int node, int contact, int lane, double wear = 0.0);

}  // namespace gearpod::lockstep
