// Options that several commands have, and the parsing of the command line (CLI11).
#pragma once

#include <CLI/CLI.hpp>
#include <memory>

#include "mc/options/number_options.hpp"
#include "mc/recordings/recording_columns.hpp"
#include "mc/run/run_options.hpp"

namespace gearpod::mc {

// Parses the arguments, which runs the command. Returns the command's exit code from `code`, or
// kBadInput if the arguments are wrong.
int parse(CLI::App& app, int argc, char** argv, const int& code);

// Rejects an empty file name for an option that names an output file.
CLI::Option* require_file_name(CLI::Option* option);

// Adds --set SECTION.KEY=VALUE. add_study() also adds the study file as a positional argument.
void add_study_keys(CLI::App& command, StudyOptions& options);
CLI::Option* add_study(CLI::App& command, StudyOptions& options);

// Adds --instances and --seed, which set keys of the study. `instances`: help text of the first.
void add_ensemble(CLI::App& command, const char* instances, StudyOptions& options);

// Adds --json, and --html for a page with figures.
void add_json(CLI::App& command, std::string& file);
void add_page(CLI::App& command, std::string& file);

// Adds --out, --resume, --force and --time-limit. `resume` and `force` are their help texts.
void add_results(CLI::App& command, RunOptions& run, const char* resume, const char* force);
void add_progress(CLI::App& command, RunOptions& run);

// Adds --force to a command whose outputs otherwise replace files of their own kind only.
void add_force(CLI::App& command, bool& force);

// Adds options for the columns, units and sampling of recordings.
void add_columns(CLI::App& command, SignalColumns& columns);

}  // namespace gearpod::mc
