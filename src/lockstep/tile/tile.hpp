// Integration of a tile of W gearboxes from rest: first to the healthy periodic orbit, then through
// the fault's passage until the motion returns to that orbit.
//
// A linear train under steady load and speed converges to an orbit that repeats every mesh period.
// A faulty tooth perturbs it and the perturbation decays. A few recorded mesh periods, arranged by
// `Pattern`, therefore represent all Z_p Z_r mesh periods that windowing uses.
// Horizon::integrate_mesh integrates all of them.
#pragma once

#include <span>

#include "lockstep/plan/fault_schedule.hpp"
#include "lockstep/tile/tile_records.hpp"

namespace gearpod::lockstep {

// `inputs` and each of `faults.curve` hold W lanes; unused lanes of the last tile repeat its last
// gearbox. A lane's result never depends on the other lanes. Tiles of 16 lanes are integrated in
// single precision. Throws std::invalid_argument if the settings or the plan do not support the
// excitation.
template <int W>
TileResult run_tile(const IntegrationPlan& plan, std::span<const dynamics::GearboxInputs> inputs,
                    const FaultCurves& faults, const TileSettings& settings);

#define GEARPOD_RUN_TILE(W)                                                          \
    extern template TileResult run_tile<W>(const IntegrationPlan&,                   \
                                           std::span<const dynamics::GearboxInputs>, \
                                           const FaultCurves&, const TileSettings&);
GEARPOD_RUN_TILE(1)
GEARPOD_RUN_TILE(4)
GEARPOD_RUN_TILE(8)
GEARPOD_RUN_TILE(16)
#undef GEARPOD_RUN_TILE

}  // namespace gearpod::lockstep
