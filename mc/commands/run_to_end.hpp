// A run once its checkpoint is open: what `run` does, and `merge` with a checkpoint that has all.
#pragma once

#include <memory>

#include "mc/commands/commands.hpp"
#include "mc/ensemble/interruption.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/numerics/study_scene.hpp"
#include "mc/results/checkpoint.hpp"

namespace gearpod::mc {

// Of rank 0. Computes what the checkpoint lacks, writes the results, says what they are and returns
// the exit code.
int run_to_end(const RunOptions& options, const StudyScene& made, const Ranks& ranks,
               std::unique_ptr<Checkpoint> checkpoint, double setup_s,
               const Interruption& interruption);

}  // namespace gearpod::mc
