// Kinds of output files, recognised by their contents. A command replaces a file of its own kind of
// output, and any other file only with --force.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mc/library/run/run_options.hpp"
#include "mc/numerics/numerics_choice.hpp"

namespace gearpod::mc {

struct OutputKind {
    std::string name;                                      // "a page (HTML)"
    std::function<bool(const std::string& path)> matches;  // true if an existing file is one
};

OutputKind json_output();
OutputKind page_output();
OutputKind sheet_output();
// A table (CSV) whose first column has this header, or a study (TOML) with such a first comment.
OutputKind text_output(const std::string& name, const std::string& beginning);
// Results file of recordings, written by `features --out`.
OutputKind recordings_output();
// HDF5 file of signals, written by `simulate --out`.
OutputKind signals_output();

// Kind of an output, and whether it may replace files of another kind.
struct Overwriting {
    OutputKind kind;
    bool force = false;
};

// Reason why the output must not replace the file at `path`, or "". A free name and an empty file
// are acceptable.
std::string why_not_replaced(const std::string& path, const Overwriting& overwriting);

// Functions for several commands: reading a study, printing problems, writing text.

// Prints every problem on a line of stderr.
void print_problems(const Problems& problems);

// Reads a study. Empty after its problems were printed.
std::optional<Study> load_study(const StudyOptions& options);

// Creates the scene of a study; without one, the result contains the problems.
StudyScene make_scene(const StudyOptions& options, Choosing choosing = Choosing::numerics);

// The same; prints the problems.
StudyScene load_scene(const StudyOptions& options);

// Prints a warning if the ensemble has too few healthy gearboxes for its false-alarm rate.
void warn_of_shortage(const EnsemblePlan& plan, const std::string& path);

// File that a command reads or writes, and its role, for example "the study" or "--json".
struct FileRole {
    std::string role, path;
};

// Returns false and prints the reason if an output cannot be written, or if it is the same file as
// one of the others, by any name. "-" and "" are not files.
bool can_write(const FileRole& output, const std::vector<FileRole>& others);

// The same; also refuses to replace a file of another kind without force.
bool can_write(const FileRole& output, const std::vector<FileRole>& others,
               const Overwriting& overwriting);

// The same for the outputs --json and --html of a command that reads other files.
bool can_write_json_and_page(const std::string& json, const std::string& html,
                             std::vector<FileRole> read, bool force);

// Reason why a results file (HDF5) should not have this name: its extension belongs to another
// format. The text suggests a name and a command that creates the other format. "" if the name is
// acceptable.
std::string why_no_results_name(const std::string& path);

// Writes to a file, or to standard output for "-". Returns false after printing a message if this
// fails.
bool write_text_to(const std::string& path, const std::string& text);

}  // namespace gearpod::mc
