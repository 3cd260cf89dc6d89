// Completes a run whose checkpoint is open; used by `run`, and by `merge` with a complete
// checkpoint.
#pragma once

#include <memory>

#include "mc/ensemble/ensemble.hpp"
#include "mc/ensemble/interruption.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/library/run/run_options.hpp"
#include "mc/numerics/numerics_choice.hpp"
#include "mc/results/checkpoint.hpp"

namespace gearpod::mc {

// Implements `run` on existing ranks. All ranks must call it.
int run_study(const RunOptions& options, const Ranks& ranks);

// Prints to stderr how to resume an interrupted run from its checkpoint.
void print_resume_hint(const EnsembleOutcome& outcome, const BatchPlan& plan,
                       const Checkpoint& checkpoint);

// Computes the missing batches, writes and prints the results, and returns the exit code. Called by
// rank 0.
int run_to_end(const RunOptions& options, const StudyScene& made, const Ranks& ranks,
               std::unique_ptr<Checkpoint> checkpoint, double setup_s,
               const Interruption& interruption);

}  // namespace gearpod::mc
