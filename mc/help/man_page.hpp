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
