// Data sets that tests share with the reference programs (reference/make_reference.*).
#pragma once

#include "tests/numbers.hpp"
#include "tests/reference_tables.hpp"

namespace gearpod::analysis {

// Columns of reference/<name>.h5.
inline std::vector<std::vector<double>> reference_columns(const std::string& name) {
    const auto table = test::reference_table("analysis/reference/" + name + ".h5");
    return test::mapped(table.names,
                        [&](const std::string& column) { return table.numbers.at(column); });
}

}  // namespace gearpod::analysis
