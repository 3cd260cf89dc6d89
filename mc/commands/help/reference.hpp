// Man page and bash completion, generated from the same command-line definition as --help.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace gearpod::mc {

// Returns the man page as roff, section 1. `version`: version_text().
std::string man_page(const CLI::App& app, const std::string& version);

// Returns a script for bash's programmable completion. It completes commands, options, values of
// options with fixed choices, and file names elsewhere.
std::string bash_completion(const CLI::App& app);

}  // namespace gearpod::mc

// The program's own descriptions as JSON: commands and options, study keys, distributions,
// features. The documentation's reference pages and the JSON schema of study files are made from
// it.

namespace CLI {
class App;
}

namespace gearpod::mc {

// One JSON object with the members `program`, `version`, `commands`, `exit_codes`, `sections`,
// `keys`, `distributions` and `features`. Numbers are in the units of the study file.
// `version`: version_text().
std::string reference_json(const CLI::App& app, const std::string& version);

}  // namespace gearpod::mc
