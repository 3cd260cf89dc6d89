// Errors of single teeth: the gap that a tooth pair would leave if the gears turned evenly, which
// it closes before it pushes (the mesh law `pushing`). The same teeth meet again only after many
// meshes, so every mesh is marched for itself (TileSettings::march_meshes).
#pragma once

#include <span>
#include <vector>

#include "gears/planetary.hpp"
#include "lockstep/plan/march.hpp"

namespace gearpod::lockstep {

// The teeth of one gear, on one of its flanks; W gearboxes. Gaps are positive.
struct GearErrors {
    int teeth = 0;
    machine::AlignedVector error_m;  // [tooth][lane]: index deviations
    // Likewise: how much the gap grows along the flank from the root's end of contact to the tip's,
    // about its middle. Empty: not at all.
    machine::AlignedVector slope_m = {};
};

// Of a pair's two gears: which, and in which mesh period its tooth 0 begins to engage there; and
// which of the two drives in the mesh's geometry (gears::MeshGeometry): that one's teeth are
// touched from the root to the tip, the other one's from the tip to the root.
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

// Whose teeth meet in a planetary train's pairs. Gears: the sun, the ring, then each planet's sun
// side and ring side, 2 + 2N in all; a planet's sides are different flanks.
std::vector<PairTeeth> planetary_teeth(const PairSet& pairs, const gears::PlanetaryTrain& train,
                                       gears::PlanetSense sense);
// Of a fixed-shaft pair: the pinion, the gear.
std::vector<PairTeeth> fixed_shaft_teeth();

// Throws std::invalid_argument unless the plan's mesh law knows tooth pairs and meshes are marched
// one by one.
void check_tooth_errors(const MarchPlan& plan, const ToothErrors* errors, int march_meshes);

// The gaps of all pairs' tooth pairs in mesh k, which counts from any integer.
std::vector<PairGaps> tooth_gaps(const MarchPlan& plan, const ToothErrors& errors, int k);

// Those of a pair in a step, or null: none.
const PairGaps* gaps_of_pair(std::span<const PairGaps> gaps, int pair, int step);

// Where StiffnessNodes::tooth_stiffness and tooth_place have one of a pair's tooth pairs.
std::size_t tooth_pair_at(const MarchPlan& plan, int step, int node, int slot, int pair);

// The gap of one of a pair's tooth pairs at a stage node, m, as the march sees it.
double tooth_gap(const MarchPlan& plan, std::span<const PairGaps> gaps, int pair, int step,
                 int node, int slot, int lane);

}  // namespace gearpod::lockstep
