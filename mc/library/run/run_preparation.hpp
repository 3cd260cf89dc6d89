// Checks the options of `run` and `merge` before the computation. All functions print problems to
// stderr.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "mc/ensemble/interruption.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/library/run/run_options.hpp"
#include "mc/numerics/numerics_choice.hpp"
#include "mc/plan/scene.hpp"

namespace gearpod::mc {

std::string results_path(const RunOptions& options);
BatchPlan plan_of(const RunOptions& options, const EnsemblePlan& plan);

bool check_time_limit(const RunOptions& options, std::optional<std::chrono::seconds>& limit);
bool check_progress(const RunOptions& options);
bool check_part(const RunOptions& options, const EnsemblePlan& plan);
bool check_signals(const RunOptions& options, const EnsemblePlan& plan);
// Checks the path of the results, of the temporary file and of the checkpoint.
bool check_output(const RunOptions& options);
// Checks the memory of this machine against the lower limit of the run's memory.
// `motion_bytes`: memory for the motion of a tile.
bool check_memory(const RunOptions& options, const EnsemblePlan& ensemble, double motion_bytes,
                  const Ranks& ranks);

// Ensures that all ranks of a run have the same program, study and seed.

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
