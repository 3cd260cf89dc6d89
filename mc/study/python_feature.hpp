// Feature of a study that a function in a Python file computes.
#pragma once

#include <string>

#include "mc/input/python_hashes.hpp"

namespace gearpod::features {
struct Feature;
}

namespace gearpod::mc {

struct PythonFeature {
    std::string file;  // absolute path
    PythonHashes hashes;
    const features::Feature* feature = nullptr;  // external

    bool operator==(const PythonFeature&) const = default;
};

}  // namespace gearpod::mc
