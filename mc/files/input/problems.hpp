// Input that cannot be used, for functions that report problems by an exception.
#pragma once

#include <cstddef>
#include <exception>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gearpod::mc {

// The message is what the program prints: one line per problem, without a final end of line.
class BadInput : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// Message for an exception that has not been translated into a problem.

// what(), or a message about exhausted memory for the exceptions that report it.
std::string exception_text(const std::exception& error);

// Problems in a user's input: collected, never thrown, and shown together.

// Position at which a key or value was written. Overrides have the file "--set" and line 0.
struct Position {
    std::string file;
    int line = 0;  // from 1; 0 if no line applies
};

// Problems that callers treat in a special way.
enum class ProblemKind {
    other,
    meshing,      // two gears do not mesh
    tooth_pairs,  // more tooth pairs touch at once than any kernel integrates
    interrupted   // the run was stopped before its first gearbox
};

// One problem. Messages have the form key: problem (reason); remedy.
struct Problem {
    std::string file = {};
    int line = 0;
    std::string key = {};     // "gearbox.module_mm"; may be empty
    std::string what = {};    // "unknown key", "must be > 0, but is -3 (a mass)"
    std::string remedy = {};  // "did you mean module_mm?"; may be empty
    ProblemKind kind = ProblemKind::other;
};

using Problems = std::vector<Problem>;

// One-line message, e.g. "studies/x.toml:12: gearbox.module: unknown key; did you mean module_mm?
// (unit missing)".
std::string format(const Problem& problem);

// Messages of the first `most` problems, one line each, and the number of the others.
std::string format(const Problems& problems, std::size_t most = std::string::npos);

// Sorts by file in order of first appearance, overrides last, and by line within a file.
void sort_problems(Problems& problems);

// Error in a study that is found only when its scene is built: numbers of steps or samples, bodies
// that no model covers.
class SceneError : public std::runtime_error {
  public:
    SceneError(std::string key, const std::string& what, std::string remedy,
               ProblemKind kind = ProblemKind::other)
        : std::runtime_error(what), key_(std::move(key)), remedy_(std::move(remedy)), kind_(kind) {}
    const std::string& key() const { return key_; }
    const std::string& remedy() const { return remedy_; }
    ProblemKind kind() const { return kind_; }

  private:
    std::string key_, remedy_;
    ProblemKind kind_;
};

}  // namespace gearpod::mc
