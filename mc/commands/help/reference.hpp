// The program's description, generated from the same command-line definition as --help.
// `version`: version_text().
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace gearpod::mc {

// Returns the man page as roff, section 1.
std::string man_page(const CLI::App& app, const std::string& version);

// Returns a script for bash's programmable completion. It completes commands, options, values of
// options with fixed choices, and file names elsewhere.
std::string bash_completion(const CLI::App& app);

// Returns one JSON object with the members `program`, `version`, `commands`, `exit_codes`,
// `sections`, `keys`, `distributions` and `features`, from which the documentation's reference pages
// and the JSON schema of study files are made. Numbers are in the units of the study file.
std::string reference_json(const CLI::App& app, const std::string& version);

}  // namespace gearpod::mc
