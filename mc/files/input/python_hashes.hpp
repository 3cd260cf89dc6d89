// Identity of a Python file by its content.
#pragma once

#include <string>
#include <vector>

namespace gearpod::mc {

// Hashes of a Python file and of the modules that it imports from its folder or below.
struct PythonHashes {
    std::string sha256;                // of the file
    std::vector<std::string> modules;  // sorted: "helper.py SHA-256", path relative to the folder

    bool operator==(const PythonHashes&) const = default;
};

}  // namespace gearpod::mc
