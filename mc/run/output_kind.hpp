// Kinds of output files, recognised by their contents. A command replaces a file of its own kind of
// output, and any other file only with --force.
#pragma once

#include <functional>
#include <string>

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

}  // namespace gearpod::mc
