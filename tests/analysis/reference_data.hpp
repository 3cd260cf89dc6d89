// Data sets that tests share with the reference programs (reference/make_reference.*).
#pragma once

#include "tests/reference_tables.hpp"
#include "tests/test.hpp"

namespace gearpod::analysis {

// Columns of reference/<name>.h5.
inline std::vector<std::vector<double>> reference_columns(const std::string& name) {
    const auto table = test::reference_table("analysis/reference/" + name + ".h5");
    std::vector<std::vector<double>> columns;
    for (const std::string& column : table.names) {
        columns.push_back(table.numbers.at(column));
    }
    return columns;
}

}  // namespace gearpod::analysis
