// Feature of a study that a function in a Python file computes.
#pragma once

#include <string>

namespace gearpod::features {
struct Feature;
}

namespace gearpod::mc {

struct PythonFeature {
    std::string file;                            // absolute path
    std::string sha256;                          // of the file's content
    const features::Feature* feature = nullptr;  // external

    bool operator==(const PythonFeature&) const = default;
};

}  // namespace gearpod::mc
