// Recognises the format of a file by its first bytes.
#pragma once

#include <string>

namespace gearpod::mc {

// Throws SignalError (signal_error.hpp) if the content has a format that is not supported, with its
// name and a way to convert it, or a supported one that does not fit the extension of the file's
// name (lower case, with its dot). An unknown content passes.
void check_file_content(const std::string& path, const std::string& extension);

}  // namespace gearpod::mc
