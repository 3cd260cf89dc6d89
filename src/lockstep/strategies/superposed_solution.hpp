// Superposed solution: the healthy mesh periods of a span are superposed from the effects of each
// gear's tooth errors (superposed_motion.hpp), in the lanes in which all tooth pairs stay in
// contact. The perturbation due to a fault is integrated from the superposed states. All other
// lanes are integrated in full. The excitation is constant.
#pragma once

#include "lockstep/plan/tooth_pairs.hpp"
#include "lockstep/tile/tile.hpp"

namespace gearpod::lockstep {

struct SuperposedSolution {
    const ToothErrors& tooth_errors;  // must outlive the strategy
    Convergence convergence = {};
    RecordedSpan span = {};
    bool superpose_faulty = false;  // otherwise lanes with a fault are integrated in full

    template <int W>
    TileResult run(const TileInputs& tile) const;
};

}  // namespace gearpod::lockstep
