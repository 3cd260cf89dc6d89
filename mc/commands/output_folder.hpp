// Folders that a command writes several files into.
#pragma once

#include <string>
#include <vector>

#include "mc/library/run/command_files.hpp"
#include "mc/report/page.hpp"

namespace gearpod::mc {

// True if every file may be written into the folder of an option: none is also one of the others,
// and none replaces a file of another kind without force. Prints each problem. The kind of a file
// follows from its name and its first line.
bool can_write_folder(const FileRole& folder, const std::vector<NamedFile>& files,
                      const std::vector<FileRole>& others, bool force);

// Writes the files into the folder, which it creates if necessary. Throws std::runtime_error like
// write_file().
void write_files(const std::string& folder, const std::vector<NamedFile>& files);

// Writes the files into the folder of option --evidence. Returns false after printing a problem if
// can_write_folder() refuses a file.
bool write_evidence(const std::string& folder, const std::vector<NamedFile>& files,
                    const std::vector<FileRole>& others, bool force);

}  // namespace gearpod::mc
