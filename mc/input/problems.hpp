// Problems in a user's input: collected, never thrown, and shown together.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gearpod::mc {

// Position at which a key or value was written. Overrides have the file "--set" and line 0.
struct Position {
    std::string file;
    int line = 0;  // from 1; 0 if no line applies
};

// One problem. Messages have the form key: problem (reason); remedy.
struct Problem {
    std::string file;
    int line = 0;
    std::string key;     // "gearbox.module_mm"; may be empty
    std::string what;    // "unknown key", "must be > 0, but is -3 (a mass)"
    std::string remedy;  // "did you mean module_mm?"; may be empty
};

using Problems = std::vector<Problem>;

// One-line message, e.g. "studies/x.toml:12: gearbox.module: unknown key; did you mean module_mm?
// (unit missing)".
std::string format(const Problem& problem);

// Messages of all problems, one line each.
std::string format(const Problems& problems);

// Sorts by file in order of first appearance, overrides last, and by line within a file.
void sort_problems(Problems& problems);

}  // namespace gearpod::mc
