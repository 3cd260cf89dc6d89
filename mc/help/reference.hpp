// The program's own descriptions as JSON: commands and options, study keys, distributions, features.
// The documentation's reference pages and the JSON schema of study files are made from it.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace gearpod::mc {

// One JSON object with the members `program`, `version`, `commands`, `exit_codes`, `sections`,
// `keys`, `distributions` and `features`. Numbers are in the units of the study file.
// `version`: version_text().
std::string reference_json(const CLI::App& app, const std::string& version);

}  // namespace gearpod::mc
