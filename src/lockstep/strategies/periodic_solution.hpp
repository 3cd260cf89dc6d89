// Periodic solution: integration from rest to the healthy periodic orbit, then through the fault's
// passage until the motion returns to that orbit.
//
// A linear train under steady load and speed converges to an orbit that repeats every mesh period.
// A faulty tooth perturbs it and the perturbation decays. A few recorded mesh periods, arranged by
// `FaultPattern`, therefore represent all Z_p Z_r mesh periods that windowing uses.
#pragma once

#include <optional>

#include "lockstep/plan/excitation.hpp"
#include "lockstep/tile/tile_inputs.hpp"
#include "lockstep/tile/tile_records.hpp"

namespace gearpod::lockstep {

struct PeriodicSolution {
    Convergence convergence = {};
    bool with_motion = false;                     // also records motions and mesh forces
    std::optional<ConstantGravity> gravity = {};  // requires at most 8 lanes

    template <int W>
    TileResult run(const TileInputs& tile) const;
};

}  // namespace gearpod::lockstep
