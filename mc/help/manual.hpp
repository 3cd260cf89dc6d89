// The command line's own description as a man page and as a completion of bash: whatever --help
// says, these say.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace gearpod::mc {

// roff, section 1. `version`: version_text().
std::string man_page(const CLI::App& app, const std::string& version);

// For bash's programmable completion: commands, their options, the values of options that take one
// of a few, files elsewhere.
std::string bash_completion(const CLI::App& app);

}  // namespace gearpod::mc
