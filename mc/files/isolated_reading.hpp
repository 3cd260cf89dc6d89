// Trial of a function in a child process, for a library that may crash or hang on a damaged file.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "mc/files/signal_file.hpp"

namespace gearpod::mc {

// Limits of a child process that calls such a library: the memory is the present use plus
// `more_memory` bytes, core files are disabled, signals have their default actions, and the process
// ends with its parent.
void confine_child(std::uintmax_t more_memory);

// Calls `read`, which reads the file at `path`, in a forked child process. Returns true if it ends,
// with or without an exception. Returns false if the library crashes, takes more than 256 MB plus
// eight times the size of the file, or does not end within 8 s plus one second per ten megabytes.
// True if no process can be created. Not thread-safe.
bool survives_reading(const std::string& path, const std::function<void()>& read);

// Signal file that is read by a child process. If a library crashes, hangs or takes all memory on a
// damaged file, only the child process is affected, and the caller gets a SignalError.

// `open` is called in a forked child process and may throw SignalError. The child may allocate 256
// MB plus 1000 times the file size. Not thread-safe.
std::unique_ptr<SignalFile> isolated_signal(
    const std::string& path, const std::function<std::unique_ptr<SignalFile>()>& open);

}  // namespace gearpod::mc
