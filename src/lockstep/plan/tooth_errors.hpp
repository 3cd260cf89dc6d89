// Pitch errors of single teeth: the static transmission error of a pair is the mean of its touching
// tooth pairs' errors, each weighed with the part of the load it carries. The same teeth meet again
// only after many meshes, so every mesh is marched for itself (TileSettings::march_meshes).
#pragma once

#include <vector>

#include "gears/planetary.hpp"
#include "lockstep/plan/march.hpp"

namespace gearpod::lockstep {

// Parts of the load, and their rates per mesh period, of the tooth pairs of all pairs during a mesh
// period. Those of a healthy gear: a fault leaves them as they are. Immutable; all tiles of an
// ensemble share it.
class LoadShares {
  public:
    LoadShares(const PairSet& pairs, const PhaseGrid& grid);

    // One for each tooth pair of `pair` that touches during a mesh period. The one that begins to
    // engage in that period has age 0, the one before it 1, and so on.
    struct ToothPair {
        int age = 0;
        std::vector<double> share, rate;  // [step][stage node]
    };
    const std::vector<ToothPair>& tooth_pairs(int pair) const {
        return tooth_pairs_[static_cast<std::size_t>(pair)];
    }

  private:
    std::vector<std::vector<ToothPair>> tooth_pairs_;
};

// The teeth of one gear, on one of its flanks; W gearboxes.
struct GearErrors {
    int teeth = 0;
    machine::AlignedVector error_m;  // [tooth][lane]; a gap is positive
};

// Of a pair's two gears: which, and in which mesh period its tooth 0 begins to engage there.
struct PairTeeth {
    int gear[2] = {};
    int first[2] = {};
};

struct ToothErrors {
    const LoadShares* shares = nullptr;
    std::vector<GearErrors> gears;
    std::vector<PairTeeth> pairs;
};

// Whose teeth meet in a planetary train's pairs. Gears: the sun, the ring, then each planet's sun
// side and ring side, 2 + 2N in all; a planet's sides are different flanks.
std::vector<PairTeeth> planetary_teeth(const PairSet& pairs, const gears::PlanetaryTrain& train,
                                       gears::PlanetSense sense);
// Of a fixed-shaft pair: the pinion, the gear.
std::vector<PairTeeth> fixed_shaft_teeth();

// Throws std::invalid_argument unless the plan's mesh law knows errors and meshes are marched one
// by one.
void check_tooth_errors(const MarchPlan& plan, const ToothErrors* errors, int march_meshes);

// The errors of all pairs in mesh k, which counts from any integer, beside what the plan's nodes
// already hold.
std::vector<PairOverride> tooth_error_overrides(const MarchPlan& plan, const ToothErrors& errors,
                                                int k);

}  // namespace gearpod::lockstep
