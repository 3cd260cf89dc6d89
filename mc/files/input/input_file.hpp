// Check of files before they are opened for reading.
#pragma once

#include <string>

namespace gearpod::mc {

// Pipe given as standard input or by a shell (/dev/stdin, /dev/fd/63).
enum class StandardInput { refused, accepted };

// Reason why a file cannot be read, for example "is a folder", or "". Opening a named pipe would
// wait for its writer, and a device may have no end; both are refused.
std::string why_not_readable(const std::string& path, StandardInput pipe = StandardInput::refused);

}  // namespace gearpod::mc
