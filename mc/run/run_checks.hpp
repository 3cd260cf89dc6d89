// Checks the options of `run` and `merge` before the computation. All functions print problems to
// stderr.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "mc/ensemble/ranks.hpp"
#include "mc/results/batch_rows.hpp"
#include "mc/run/run_options.hpp"
#include "mc/scene/scene.hpp"

namespace gearpod::mc {

std::string results_path(const RunOptions& options);
// Batches that this run computes.
BatchPlan plan_of(const RunOptions& options, const Study& study);

bool check_time_limit(const RunOptions& options, std::optional<std::chrono::seconds>& limit);
bool check_progress(const RunOptions& options);
bool check_part(const RunOptions& options, const Study& study);
bool check_watch(const RunOptions& options, const Study& study);
bool check_signals(const RunOptions& options, const Study& study);
// Checks the path of the results, of the temporary file and of the checkpoint.
bool check_output(const RunOptions& options);
// Checks the memory of this machine against the lower limit of the run's memory.
bool check_memory(const RunOptions& options, const Scene& scene, const Ranks& ranks);

}  // namespace gearpod::mc
