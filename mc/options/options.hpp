// Command-line definition (CLI11). Each add_...() function adds a command, which fills its options,
// runs and stores its exit code in `code`.
#pragma once

#include <CLI/CLI.hpp>

#include "mc/commands/commands.hpp"
#include "mc/options/number_options.hpp"

namespace gearpod::mc {

// Parses the arguments, which runs the command. Returns the command's exit code from `code`, or
// kBadInput if the arguments are wrong.
int parse(CLI::App& app, int argc, char** argv, const int& code);

// Rejects an empty file name for an option that names an output file.
CLI::Option* require_file_name(CLI::Option* option);

// Adds --set SECTION.KEY=VALUE. add_study() also adds the study file as a positional argument.
void add_study_keys(CLI::App& command, StudyOptions& options);
CLI::Option* add_study(CLI::App& command, StudyOptions& options);

// Adds an option that sets a key of the study, for example --seed S.
void add_shorthand(CLI::App& command, const char* name, const char* key, const char* doc,
                   StudyOptions& options);

// Adds --out, --resume, --force and --time-limit. `resume` and `force` are their help texts.
void add_results(CLI::App& command, RunOptions& run, const char* resume, const char* force);
void add_progress(CLI::App& command, RunOptions& run);

// Adds --force to a command whose outputs otherwise replace files of their own kind only.
void add_force(CLI::App& command, bool& force);

void add_run(CLI::App& app, RunOptions& run, int& code);
void add_new(CLI::App& app, NewOptions& options, int& code);
void add_sweep(CLI::App& app, SweepOptions& options, int& code);
void add_lives(CLI::App& app, LivesOptions& options, int& code);
void add_features(CLI::App& app, FeaturesOptions& features, int& code);
void add_calibrate(CLI::App& app, CalibrateOptions& calibrate, int& code);
void add_pod(CLI::App& app, PodOptions& pod, int& code);
void add_report(CLI::App& app, ReportOptions& report, int& code);
void add_repair(CLI::App& app, RepairOptions& repair, int& code);
void add_misses(CLI::App& app, MissesOptions& misses, int& code);
void add_rare(CLI::App& app, RareOptions& rare, int& code);
void add_compare(CLI::App& app, CompareOptions& compare, int& code);

}  // namespace gearpod::mc
