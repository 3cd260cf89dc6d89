// Fault perturbation: only the mesh periods that the faults of the gearboxes change are integrated,
// from the states of their healthy solution until the perturbation has decayed in each lane by
// itself. Tooth errors are those of the healthy solution, whose excitation
// must be constant.
#pragma once

#include "lockstep/plan/tooth_errors.hpp"
#include "lockstep/tile/tile_inputs.hpp"
#include "lockstep/tile/tile_records.hpp"

namespace gearpod::lockstep {

struct FaultPerturbation {
    // States of the same gearboxes without faults; they state the span and its run-in. Must outlive
    // the strategy.
    const SpanStates& healthy;
    Convergence convergence = {};
    const ToothErrors* tooth_errors = nullptr;  // or null

    template <int W>
    TileResult run(const TileInputs& tile) const;
};

}  // namespace gearpod::lockstep
