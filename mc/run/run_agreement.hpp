// All ranks of a run must compute the same: the same program, study and seed.
#pragma once

#include "mc/ensemble/interruption.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/numerics/study_scene.hpp"
#include "mc/run/run_options.hpp"

namespace gearpod::mc {

// The scene in every rank, or nothing in any of them after rank 0 said why: a problem of the study,
// or the rank that cannot read it, has another one or runs another program. All call it together.
// An interruption is such a reason as well.
StudyScene load_scene_together(const Ranks& ranks, const StudyOptions& options,
                               const Interruption& interruption);

// Whether that interruption is the problem, of this rank.
bool left_off(const Problems& problems);

}  // namespace gearpod::mc
