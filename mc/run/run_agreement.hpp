// Ensures that all ranks of a run have the same program, study and seed.
#pragma once

#include <functional>

#include "mc/ensemble/interruption.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/numerics/study_scene.hpp"
#include "mc/run/run_options.hpp"

namespace gearpod::mc {

// Loads the scene in every rank. If one rank fails, no rank gets a scene, and rank 0 prints the
// reason: a problem of the study, an interruption, or a rank that cannot read the study, has
// another study or runs another program. All ranks must call it together. `prepare` completes a
// scene that was made, and may replace it or refuse it with problems.
StudyScene load_scene_on_all_ranks(const Ranks& ranks, const StudyOptions& options,
                                   const Interruption& interruption,
                                   const std::function<void(StudyScene&)>& prepare = {});

// True if an interruption of this rank was the problem.
bool was_interrupted(const Problems& problems);

}  // namespace gearpod::mc
