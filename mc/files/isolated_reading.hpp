// Trial of a function in a child process, for a library that may crash or hang on a damaged file.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace gearpod::mc {

// Calls `read`, which reads the file at `path`, in a forked child process. Returns true if it ends,
// with or without an exception. Returns false if the library crashes, takes more than 256 MB plus
// this many bytes per byte of the file, or does not end within 10 s plus one second per ten
// megabytes. True if no process can be created. Not thread-safe.
bool survives_reading(const std::string& path, const std::function<void()>& read,
                      std::uintmax_t memory_per_byte = 8);

}  // namespace gearpod::mc
