// Strategies that integrate mesh periods: all of a span, those until the motion is periodic, or
// those that a fault changes.
#pragma once

#include <optional>

#include "lockstep/plan/excitation.hpp"
#include "lockstep/plan/tooth_pairs.hpp"
#include "lockstep/tile/tile.hpp"

namespace gearpod::lockstep {

// Full solution: every mesh period of a span is integrated, after a run-in from the healthy
// periodic orbit.
struct FullSolution {
    Convergence convergence = {};
    RecordedSpan span = {};
    const ToothErrors* tooth_errors = nullptr;  // or null; requires a plan with single tooth pairs
    const Excitation* excitation = nullptr;     // or null; requires at most 8 lanes

    template <int W>
    TileResult run(const TileInputs& tile) const;
};

// Periodic solution: integration from rest to the healthy periodic orbit, then through the fault's
// passage until the motion returns to that orbit.
//
// A linear train under steady load and speed converges to an orbit that repeats every mesh period.
// A faulty tooth perturbs it and the perturbation decays. A few recorded mesh periods, arranged by
// `FaultPattern`, therefore represent all Z_p Z_r mesh periods that windowing uses.
struct PeriodicSolution {
    Convergence convergence = {};
    bool with_motion = false;                     // also records motions and mesh forces
    std::optional<ConstantGravity> gravity = {};  // requires at most 8 lanes

    template <int W>
    TileResult run(const TileInputs& tile) const;
};

// Fault perturbation: only the mesh periods that the faults of the gearboxes change are integrated,
// from the states of their healthy solution until the perturbation has decayed in each lane by
// itself. Tooth errors are those of the healthy solution, whose excitation
// must be constant.
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
