// Inspections of analysis/reference and requests for their curves.
#pragma once

#include "analysis/inspection.hpp"
#include "tests/test.hpp"

namespace gearpod::analysis {

// Columns of a table that is also an input of the command `pod`; its first line is a heading.
inline std::vector<std::vector<double>> table_columns(const std::string& name) {
    std::ifstream file(GEARPOD_TESTS_DIR "/analysis/reference/" + name);
    std::string line;
    if (!std::getline(file, line)) {
        throw std::runtime_error("cannot read the table " + name);
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

inline Inspections hits(bool repeated) {
    const auto columns = table_columns("inspections_hits.csv");
    Inspections data{columns[1], columns[2], {}};
    for (std::size_t i = 0; i < columns[0].size(); ++i) {
        data.specimen.push_back(repeated ? std::lround(columns[0][i]) : static_cast<long>(i));
    }
    return data;
}

inline Inspections responses(bool repeated) {
    const auto columns = table_columns("inspections_responses.csv");
    Inspections data;
    for (std::size_t i = 0; i < columns[0].size(); ++i) {
        for (std::size_t m = 2; m < (repeated ? 5 : 3); ++m) {
            data.size.push_back(columns[1][i]);
            data.value.push_back(columns[m][i]);
            data.specimen.push_back(static_cast<long>(i));
        }
    }
    return data;
}

inline InspectionRequest of_hits(Link link, bool log_size) {
    InspectionRequest request;
    request.simulated_tables = 0;
    request.links = {link};
    request.log_sizes = {log_size};
    return request;
}

inline InspectionRequest of_responses() {
    InspectionRequest request;
    request.simulated_tables = 0;
    request.responses = true;
    request.threshold = 6.0;
    request.log_sizes = {true};
    request.powers = {0.0};
    request.accept_failed_checks = true;
    return request;
}

}  // namespace gearpod::analysis
