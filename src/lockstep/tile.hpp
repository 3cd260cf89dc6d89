// A tile of W gearboxes from rest to everything their sensors will see: the healthy orbit, marched
// until it repeats, and the fault's passage, marched until the orbit is back.
//
// A linear train under steady load and speed settles on an orbit that repeats every mesh period. A
// faulty tooth disturbs it and the disturbance decays. So a few recorded mesh periods, arranged by
// `Pattern`, stand for the Z_p Z_r meshes that windowing looks at. Horizon::march marches them all.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lockstep/march.hpp"
#include "stiffness/cracked_pair.hpp"

namespace gearpod::lockstep {

enum class LaneStatus { ok, diverged, unsettled };

// A faulty tooth's engagement in one pattern: it replaces a healthy tooth pair of `pair` from phase
// `start` (mesh periods) for a contact ratio.
struct FaultPassage {
    int pair = 0;
    double start = 0.0;
};

// The fault's repetition: passages in mesh periods [0, length), ascending start; length is the number
// of meshes after which the same teeth meet again (Z_p, Z_s or Z_r).
struct FaultPattern {
    int length = 1;
    std::vector<FaultPassage> passages;
};

struct TileSettings {
    double tolerance = 1e-10;  // of the state, relative, when orbit or decay count as reached
    int max_meshes = 200;      // of one approach to the orbit or of one decay
    int march_meshes = 0;      // 0: reuse; else: record so many meshes one by one
    bool with_motion = false;
};

// Recorded mesh periods: 0 is the healthy one; mesh k of the span shows records[content[k mod L]].
struct TileResult {
    std::vector<MeshRecord> records;
    std::vector<int> content;        // L = content.size()
    std::vector<LaneStatus> status;  // per lane
    int marched_meshes = 0;
};

// What marching a tile needs besides the plan: the pairs' curves for the faulty tooth.
struct FaultCurves {
    const PairSet* pairs = nullptr;
    dynamics::MeshDamping damping = dynamics::MeshDamping::ratio;
    FaultPattern pattern;
    // One per lane; a lane without a fault has none and keeps its healthy orbit to the bit.
    std::vector<std::optional<stiffness::CrackedToothCurve>> cracked;
};

// `inputs` and `faults.cracked` hold W lanes; unused lanes of the last tile repeat the first one.
// A lane's result never depends on its neighbours.
template <int W>
TileResult run_tile(const MarchPlan& plan, std::span<const dynamics::PlanetaryInputs> inputs,
                    const FaultCurves& faults, const TileSettings& settings);

extern template TileResult run_tile<1>(const MarchPlan&,
                                       std::span<const dynamics::PlanetaryInputs>,
                                       const FaultCurves&, const TileSettings&);
extern template TileResult run_tile<8>(const MarchPlan&,
                                       std::span<const dynamics::PlanetaryInputs>,
                                       const FaultCurves&, const TileSettings&);

}  // namespace gearpod::lockstep
