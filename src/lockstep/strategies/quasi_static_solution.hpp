// Quasi-static solution: W gearboxes without inertia, in static equilibrium K(phase) q = f at every
// sample. It has no memory, so a mesh period depends only on the teeth engaged in it.
//
// Records hold the transmission error and, if requested, the motion. They have no acceleration,
// because a model without inertia has no vibration to measure. The free rigid rotation is omitted.
// A lane whose load meets no stiffness (all teeth that could carry it are broken) has no
// equilibrium: it is `diverged` and its records are NaN. A lane whose contacts keep opening and
// closing is `not_converged`. The centrifugal force of the layout's inertial terms counts as a
// load.
#pragma once

#include <optional>
#include <variant>

#include "lockstep/plan/excitation.hpp"
#include "lockstep/plan/tooth_pairs.hpp"
#include "lockstep/tile/tile.hpp"

namespace gearpod::lockstep {

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

}  // namespace gearpod::lockstep
