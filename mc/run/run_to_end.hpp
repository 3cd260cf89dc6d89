// A run once its checkpoint is open: what `run` does, and `merge` with a checkpoint that has all.
#pragma once

#include <memory>

#include "mc/ensemble/ensemble_run.hpp"
#include "mc/ensemble/interruption.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/numerics/study_scene.hpp"
#include "mc/results/checkpoint.hpp"
#include "mc/run/run_options.hpp"

namespace gearpod::mc {

// `run` itself, by ranks that are there already. All of them call it.
int run_study(const RunOptions& options, const Ranks& ranks);

// That a run which ends before its time goes on from its checkpoint, on stderr.
void print_kept(const EnsembleOutcome& outcome, const BatchPlan& plan,
                const Checkpoint& checkpoint);

// Of rank 0. Computes what the checkpoint lacks, writes the results, says what they are and returns
// the exit code.
int run_to_end(const RunOptions& options, const StudyScene& made, const Ranks& ranks,
               std::unique_ptr<Checkpoint> checkpoint, double setup_s,
               const Interruption& interruption);

}  // namespace gearpod::mc
