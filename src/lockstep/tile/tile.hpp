// A tile of W gearboxes from rest to everything their sensors will see: the healthy orbit, marched
// until it repeats, and the fault's passage, marched until the orbit is back.
//
// A linear train under steady load and speed settles on an orbit that repeats every mesh period. A
// faulty tooth disturbs it and the disturbance decays. So a few recorded mesh periods, arranged by
// `Pattern`, stand for the Z_p Z_r meshes that windowing looks at. Horizon::march marches them all.
#pragma once

#include <span>
#include <vector>

#include "lockstep/plan/excitation.hpp"
#include "lockstep/plan/fault_schedule.hpp"
#include "lockstep/plan/march.hpp"

namespace gearpod::lockstep {

enum class LaneStatus { ok, diverged, unsettled };

struct TileSettings {
    double tolerance = 1e-10;  // of the state, relative, when orbit or decay count as reached
    int max_meshes = 200;      // of one approach to the orbit or of one decay
    int march_meshes = 0;      // 0: reuse; else: record so many meshes one by one
    // Marched before them: with tooth errors, or an excitation that does not repeat, there is no
    // orbit to start from; the tile starts from the one without.
    int run_in_meshes = 0;
    bool with_motion = false;
    // Of meshes that are marched one by one: keep the state at the beginning of each.
    bool keep_states = false;
    // States that were kept of the same gearboxes without faults and with the same settings, or
    // null: what the faults leave as it was is not marched again.
    const std::vector<TileState>* healthy = nullptr;
    // What drives these gearboxes unevenly, or null. One that does not repeat every mesh period
    // needs march_meshes.
    const Excitation* excitation = nullptr;
};

// In place of a record: the mesh is as it was without faults, to the tolerance.
inline constexpr int kUnchanged = -1;

// Recorded mesh periods: 0 is the healthy one; mesh k of the span shows records[content[k mod L]].
// With TileSettings::healthy the records are those of the changed meshes.
struct TileResult {
    std::vector<MeshRecord> records;
    std::vector<int> content;        // L = content.size()
    std::vector<TileState> states;   // kept ones: before each marched mesh and after the last
    std::vector<LaneStatus> status;  // per lane
    int marched = 0;                 // mesh periods that the tile marched or solved in all
};

// `inputs` and each of `faults.curve` hold W lanes; unused lanes of the last tile repeat its last
// one. A lane's result never depends on its neighbours. Tiles of 16 march in single precision.
// Throws std::invalid_argument for an excitation that the settings or the plan cannot march.
template <int W>
TileResult run_tile(const MarchPlan& plan, std::span<const dynamics::GearboxInputs> inputs,
                    const FaultCurves& faults, const TileSettings& settings);

#define GEARPOD_RUN_TILE(W)                                                          \
    extern template TileResult run_tile<W>(const MarchPlan&,                         \
                                           std::span<const dynamics::GearboxInputs>, \
                                           const FaultCurves&, const TileSettings&);
GEARPOD_RUN_TILE(1)
GEARPOD_RUN_TILE(4)
GEARPOD_RUN_TILE(8)
GEARPOD_RUN_TILE(16)
#undef GEARPOD_RUN_TILE

}  // namespace gearpod::lockstep
