// A signal file that a process of its own reads: what a library does with a damaged one (end by a
// signal, turn in circles, take all memory) it does there, and here it is a SignalError.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "mc/files/signal_file.hpp"

namespace gearpod::mc {

// `open` is called in the other process, a copy of this one, and may throw SignalError; it may
// allocate 256 MB and a thousand times the file's bytes. One call at a time.
std::unique_ptr<SignalFile> isolated_signal(
    const std::string& path, const std::function<std::unique_ptr<SignalFile>()>& open);

}  // namespace gearpod::mc
