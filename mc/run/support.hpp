// What several commands share: reading a study, printing problems, writing text.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mc/numerics/study_scene.hpp"
#include "mc/run/run_options.hpp"

namespace gearpod::mc {

// Prints every problem on stderr, one a line.
void print_problems(const Problems& problems);

// The study, or nothing after its problems were printed.
std::optional<Study> load_study(const StudyOptions& options);

// The scene of a study, or why there is none.
StudyScene make_scene(const StudyOptions& options);

// The same; prints the problems.
StudyScene load_scene(const StudyOptions& options);

// A file that a command reads or writes, and as what: "the study", "--json".
struct FileRole {
    std::string role, path;
};

// Prints why an output cannot be written, if so: for the file itself, or because it is a file, by
// whatever name, that the command has another use for. "-" and "" are no files.
bool can_write(const FileRole& output, const std::vector<FileRole>& others);

// Why results, which are HDF5, should not have that name: it is another kind of file's. With the
// right name, and what makes that other kind. "" if nothing is wrong.
std::string why_no_results_name(const std::string& path);

// Writes to a file, or to standard output for "-". False after a message if the file fails.
bool write_text_to(const std::string& path, const std::string& text);

}  // namespace gearpod::mc
