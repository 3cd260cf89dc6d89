// Full solution: every mesh period of a span is integrated, after a run-in from the healthy
// periodic orbit.
#pragma once

#include "lockstep/plan/excitation.hpp"
#include "lockstep/plan/tooth_errors.hpp"
#include "lockstep/tile/tile_inputs.hpp"
#include "lockstep/tile/tile_records.hpp"

namespace gearpod::lockstep {

struct FullSolution {
    Convergence convergence = {};
    RecordedSpan span = {};
    const ToothErrors* tooth_errors = nullptr;  // or null; requires a plan with single tooth pairs
    const Excitation* excitation = nullptr;     // or null; requires at most 8 lanes

    template <int W>
    TileResult run(const TileInputs& tile) const;
};

}  // namespace gearpod::lockstep
