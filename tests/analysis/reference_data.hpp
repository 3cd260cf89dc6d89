// Data sets that tests share with the reference programs (reference/make_reference.*).
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace gearpod::analysis {

// Columns of reference/<name>; its first line is a heading.
inline std::vector<std::vector<double>> reference_columns(const std::string& name) {
    std::ifstream file(std::filesystem::path(GEARPOD_REFERENCE_DIR) / name);
    std::string line;
    if (!std::getline(file, line)) {
        throw std::runtime_error("cannot read the reference data " + name);
    }
    std::vector<std::vector<double>> columns;
    while (std::getline(file, line)) {
        std::istringstream cells(line);
        std::string cell;
        for (std::size_t c = 0; std::getline(cells, cell, ','); ++c) {
            columns.resize(std::max(columns.size(), c + 1));
            columns[c].push_back(std::stod(cell));
        }
    }
    return columns;
}

}  // namespace gearpod::analysis
