// Strategies for the solution of a tile. Each is a type with exactly the inputs that it uses;
// adding one takes its header, its source, and its name in the list below.
#pragma once

#include <algorithm>
#include <optional>
#include <variant>

#include "lockstep/plan/excitation.hpp"
#include "lockstep/plan/tooth_pairs.hpp"
#include "lockstep/tile/tile.hpp"
#include "machine/contracts.hpp"

namespace gearpod::lockstep {

// Strategies that integrate mesh periods: all of a span, those until the motion is periodic, or
// those that a fault changes.

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

// Superposed solution: the healthy mesh periods of a span are superposed from the effects of each
// gear's tooth errors (superposed_motion.hpp), in the lanes in which all tooth pairs stay in
// contact. The perturbation due to a fault is integrated from the superposed states. All other
// lanes are integrated in full. The excitation is constant.

struct SuperposedSolution {
    const ToothErrors& tooth_errors;  // must outlive the strategy
    Convergence convergence = {};
    RecordedSpan span = {};
    bool superpose_faulty = false;  // otherwise lanes with a fault are integrated in full

    template <int W>
    TileResult run(const TileInputs& tile) const;
};

// Quasi-static solution: W gearboxes without inertia, in static equilibrium K(phase) q = f at every
// sample. It has no memory, so a mesh period depends only on the teeth engaged in it.
//
// Records hold the transmission error and, if requested, the motion. They have no acceleration,
// because a model without inertia has no vibration to measure. The free rigid rotation is omitted.
// A lane whose load meets no stiffness (all teeth that could carry it are broken) has no
// equilibrium: it is `diverged` and its records are NaN. A lane whose contacts keep opening and
// closing is `not_converged`. The centrifugal force of the layout's inertial terms counts as a
// load.

// The healthy mesh period, and those of the fault pattern in which a fault passes.
struct StaticPattern {
    bool with_motion = false;  // also records motions and mesh forces
    std::optional<ConstantGravity> gravity = {};
};

// Every mesh period of a span if they differ; otherwise the pattern, repeated over the span.
struct StaticSpan {
    int meshes = 1;
    int motion_meshes = 0;                      // as in RecordOptions
    const ToothErrors* tooth_errors = nullptr;  // or null; requires a plan with single tooth pairs
    const VaryingForces* forces = nullptr;      // or null
};

// Requires at most 8 lanes, and a plan with a stage node at the start of every step.
struct QuasiStaticSolution {
    std::variant<StaticPattern, StaticSpan> meshes = {};

    template <int W>
    TileResult run(const TileInputs& tile) const;
};

using Solution = std::variant<PeriodicSolution, FullSolution, SuperposedSolution, FaultPerturbation,
                              QuasiStaticSolution>;

// Solves a tile of W lanes: 1, 4, 8, or 16 in single precision. A lane's result never depends on
// the other lanes. Throws std::invalid_argument if the plan does not support the excitation or the
// tooth errors of the strategy.
template <int W>
TileResult run_tile(const IntegrationPlan& plan, std::span<const dynamics::GearboxInputs> gearboxes,
                    const FaultCurves& faults, const Solution& solution) {
    EXPECTS(gearboxes.size() == W &&
            std::ranges::all_of(faults.curve, [](const auto& lanes) { return lanes.size() == W; }));
    const TileInputs tile{plan, gearboxes, faults};
    return std::visit([&](const auto& strategy) { return strategy.template run<W>(tile); },
                      solution);
}

}  // namespace gearpod::lockstep
