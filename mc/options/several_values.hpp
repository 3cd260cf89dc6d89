// Options that take several values, `--hit A B C` as well as `--hit A --hit B --hit C`.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace gearpod::mc {

// Reason why the checks of an option refuse a value, or "".
std::string check_problem(const CLI::Option& option, const std::string& value);

// Writes the name of an option before each of its values: `--hit A B` becomes `--hit A --hit B`.
// `words` are the arguments after the command's name. A word belongs to the option before it unless
// it begins with a hyphen, fails the option's checks, or lacks the equals sign of the option's type
// (SECTION.KEY=VALUE). If the command needs a file name and no other word can be it, the last word
// after an option is that file name.
std::vector<std::string> separate_values(const CLI::App& command,
                                         const std::vector<std::string>& words);

}  // namespace gearpod::mc
