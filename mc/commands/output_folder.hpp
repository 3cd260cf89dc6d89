// Outputs of several commands: JSON with its page, and folders that several files are written into.
#pragma once

#include <string>
#include <vector>

#include "analysis/report/report.hpp"
#include "mc/ensemble/gearbox/simulation.hpp"
#include "mc/library/run/command_files.hpp"
#include "mc/report/page.hpp"

namespace gearpod::mc {

// Writes JSON, and the page and figures made from it, to the files of --json, --html and --figures;
// "": none. Returns false after printing a problem with the JSON; throws like write_report_page().
bool write_json_and_page(const nlohmann::json& json, const std::string& file,
                         const std::string& html, const std::string& figures = "");

// Prints all findings, or the first screen of them with a hint at --full.
void print_findings(const analysis::Report& report, bool full);

// Prints "page: F.html" after an empty line, for an output that was written; "": none.
void print_written(const char* what, const std::string& path);

// Signals of equal length as CSV with so many digits. With `units` the header is "name [unit]".
std::string columns_csv(const std::vector<SignalColumn>& columns, int digits, bool units);

// Option that names a folder, with the folder's path, and the files to be written into it.
struct OutputFolder {
    FileRole role;
    std::vector<NamedFile> files;
};

// True if every file may be written: none is also one of the others, and none replaces a file of
// another kind without force. Prints each problem. The kind of a file follows from its name and its
// first line.
bool can_write_folders(const std::vector<OutputFolder>& folders,
                       const std::vector<FileRole>& others, bool force);

// Writes the files into the folder, which it creates if necessary. Throws std::runtime_error like
// write_file().
void write_files(const OutputFolder& folder);

}  // namespace gearpod::mc
