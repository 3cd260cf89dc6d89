// Recognises the format of a file by its first bytes.
#pragma once

#include <filesystem>
#include <string>

namespace gearpod::mc {

// Throws SignalError (signal_error.hpp) if the content has a format that is not supported, with its
// name and a way to convert it, or a supported one that does not fit the extension of the file's
// name. An unknown content passes.
void check_file_content(const std::string& path);

// Extension of the file's name, in lower case and with its dot.
std::string lower_extension(const std::filesystem::path& path);

}  // namespace gearpod::mc
