// A tile of W gearboxes from rest to everything their sensors will see: the healthy orbit, marched
// until it repeats, and the fault's passage, marched until the orbit is back.
//
// A linear train under steady load and speed settles on an orbit that repeats every mesh period. A
// faulty tooth disturbs it and the disturbance decays. So a few recorded mesh periods, arranged by
// `Pattern`, stand for the Z_p Z_r meshes that windowing looks at. Horizon::march marches them all.
#pragma once

#include <span>

#include "lockstep/plan/fault_schedule.hpp"
#include "lockstep/tile/tile_records.hpp"

namespace gearpod::lockstep {

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
