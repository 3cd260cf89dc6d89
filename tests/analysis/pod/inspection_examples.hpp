// Inspections of analysis/reference and requests for their curves.
#pragma once

#include <cmath>

#include "analysis/inspection.hpp"
#include "tests/analysis/reference_data.hpp"

namespace gearpod::analysis {

inline Inspections hits(bool repeated) {
    const auto columns = reference_columns("inspections_hits.csv");
    Inspections data{columns[1], columns[2], {}};
    for (std::size_t i = 0; i < columns[0].size(); ++i) {
        data.specimen.push_back(repeated ? std::lround(columns[0][i]) : static_cast<long>(i));
    }
    return data;
}

inline Inspections responses(bool repeated) {
    const auto columns = reference_columns("inspections_responses.csv");
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
