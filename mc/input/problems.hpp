// What is wrong with a user's input: collected, never thrown, shown all at once.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gearpod::mc {

// Where a key or value was written. Overrides have the file "--set" and line 0.
struct Position {
    std::string file;
    int line = 0;  // 1 for the first line; 0 where no line applies
};

// One grammar for all messages: key: what is wrong (why it is wrong); what to do instead.
struct Problem {
    std::string file;
    int line = 0;
    std::string key;     // "gearbox.module_mm"; may be empty
    std::string what;    // "unknown key", "must be > 0, but is -3 (a mass)"
    std::string remedy;  // "did you mean module_mm?"; may be empty
};

using Problems = std::vector<Problem>;

// "studies/x.toml:12: gearbox.module: unknown key; did you mean module_mm? (unit missing)"
std::string format(const Problem& problem);

// One line a problem.
std::string format(const Problems& problems);

// By file in order of first appearance, overrides last; by line within a file.
void sort_problems(Problems& problems);

}  // namespace gearpod::mc
