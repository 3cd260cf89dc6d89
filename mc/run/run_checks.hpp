// What `run` and `merge` ask of their options before anything is computed. All say what is wrong on
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
// Of the gearboxes that this run computes.
BatchPlan plan_of(const RunOptions& options, const Study& study);

bool check_time_limit(const RunOptions& options, std::optional<std::chrono::seconds>& limit);
bool check_progress(const RunOptions& options);
bool check_part(const RunOptions& options, const Study& study);
bool check_watch(const RunOptions& options, const Study& study);
bool check_signals(const RunOptions& options, const Study& study);
// The results are written under another name first, and batches go into the checkpoint.
bool check_output(const RunOptions& options);
// What the run holds at least, on this machine.
bool check_memory(const RunOptions& options, const Scene& scene, const Ranks& ranks);

}  // namespace gearpod::mc
