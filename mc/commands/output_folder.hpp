// Folders that a command writes several files into.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "mc/library/run/command_files.hpp"
#include "mc/report/tables.hpp"

namespace gearpod::mc {

// True if every file may be written into the folder of an option: none is also one of the others,
// and none replaces a file of another kind without force. Prints each problem. The kind of a file
// follows from its name and its first line.
bool can_write_folder(const FileRole& folder, const std::vector<NamedFile>& files,
                      const std::vector<FileRole>& others, bool force);

// Writes the evidence pack of a report into a folder: evidence_files(report). Returns false after
// printing a problem if can_write_folder() refuses a file.
bool write_evidence(const std::string& folder, const nlohmann::json& report,
                    const std::vector<FileRole>& others, bool force);

}  // namespace gearpod::mc
