// Helpers for tests that read recordings.
#pragma once

#include "mc/files/signal_file.hpp"
#include "tests/mc/program.hpp"

namespace gearpod::test {

inline std::string file_with(const Folder& folder, const std::string& name,
                             const std::string& bytes) {
    write_bytes(folder.file(name), bytes);
    return folder.file(name);
}

// Message of the error in reading a file, or "".
template <class Read>
std::string error_in(Read read) {
    try {
        read();
    } catch (const mc::SignalError& error) {
        return error.what();
    }
    return "";
}

// Message of the error in reading all columns of a file, or "".
inline std::string reading_error(const std::string& path) {
    return error_in([&] {
        const auto file = mc::open_signal_file(path);
        for (const std::string& name : file->names()) {
            static_cast<void>(file->read(name));
        }
        static_cast<void>(file->sampling_Hz());
    });
}

}  // namespace gearpod::test
