// Signal file that is read by a child process. If a library crashes, hangs or takes all memory on a
// damaged file, only the child process is affected, and the caller gets a SignalError.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "mc/files/signal_file.hpp"

namespace gearpod::mc {

// `open` is called in a forked child process and may throw SignalError. The child may allocate 256
// MB plus 1000 times the file size. Not thread-safe.
std::unique_ptr<SignalFile> isolated_signal(
    const std::string& path, const std::function<std::unique_ptr<SignalFile>()>& open);

}  // namespace gearpod::mc
