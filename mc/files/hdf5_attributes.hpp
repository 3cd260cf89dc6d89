// Attributes of HDF5 objects that any program may have written.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mc/files/hdf5_handle.hpp"

namespace gearpod::mc {

struct Hdf5Attribute {
    std::string name;
    // Either texts, of fixed or variable length, or numbers; one for a scalar. Both are empty for
    // other types.
    std::vector<std::string> texts;
    std::vector<double> numbers;

    // The only number, also if it is written as text.
    std::optional<double> number() const;
};

// Attributes of an open object, at most a thousand values each. Throws Hdf5Error.
std::vector<Hdf5Attribute> attributes_of(hid_t object);

// Reason why a file cannot be opened as HDF5: it was not closed, is truncated, or is another kind
// of file, which is named. Empty if none is found.
std::string hdf5_open_problem(const std::string& path);

}  // namespace gearpod::mc
