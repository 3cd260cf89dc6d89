// Tables of reference numbers: HDF5 files with a dataset per column (tests/README.md).
#pragma once

#include <map>
#include <string>
#include <vector>

namespace gearpod::test {

struct ReferenceTable {
    std::vector<std::string> names;  // of the columns of numbers, in their order
    std::map<std::string, std::vector<double>> numbers;
    std::map<std::string, std::vector<std::string>> texts;
};

// Reads the table at a path from tests/. Throws mc::Hdf5Error if the file cannot be read.
ReferenceTable reference_table(const std::string& path);

}  // namespace gearpod::test
