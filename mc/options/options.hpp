// The command line's options, as CLI11 reads them. Commands of several options have an add_...() of
// their own: it adds the command, which fills its options and leaves its exit code in `code`.
#pragma once

#include <CLI/CLI.hpp>

#include "mc/commands/commands.hpp"

namespace gearpod::mc {

// The exit code of the command that the arguments ask for, which leaves it in `code`, or of their
// refusal.
int parse(CLI::App& app, int argc, char** argv, const int& code);

// Of an option that names a file to write: "" would be no file, or another than the one meant.
CLI::Option* needs_name(CLI::Option* option);

// --set SECTION.KEY=VALUE; and with it the study's path, the first positional argument.
void add_study_keys(CLI::App& command, StudyOptions& options);
CLI::Option* add_study(CLI::App& command, StudyOptions& options);

// --instances N and --seed S are short for keys of the study.
void add_shorthand(CLI::App& command, const char* name, const char* key, const char* doc,
                   StudyOptions& options);

// Where a run keeps its results and how long it may take; `resume` and `force` say what these do.
void add_results(CLI::App& command, RunOptions& run, const char* resume, const char* force);
void add_progress(CLI::App& command, RunOptions& run);

void add_run(CLI::App& app, RunOptions& run, int& code);
void add_new(CLI::App& app, NewOptions& options, int& code);
void add_sweep(CLI::App& app, SweepOptions& options, int& code);
void add_lives(CLI::App& app, LivesOptions& options, int& code);
void add_features(CLI::App& app, FeaturesOptions& features, int& code);
void add_calibrate(CLI::App& app, CalibrateOptions& calibrate, int& code);
void add_pod(CLI::App& app, PodOptions& pod, int& code);
void add_report(CLI::App& app, ReportOptions& report, int& code);
void add_misses(CLI::App& app, MissesOptions& misses, int& code);
void add_rare(CLI::App& app, RareOptions& rare, int& code);
void add_compare(CLI::App& app, CompareOptions& compare, int& code);

}  // namespace gearpod::mc
