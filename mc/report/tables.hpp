// The tables of a report as CSV files: units in the column names, a missing number an empty field.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace gearpod::mc {

struct CsvTable {
    std::string name;  // of the file, without .csv
    std::vector<std::string> columns;
    std::vector<std::string> rows;  // fields joined, no end of line
};

// Every table of report_json()'s JSON that has rows: detection, smallest_fault, pod, pod_band, roc,
// ranking, misses, sensitivity, inputs, a90_by_input, combined, conditions, numerical, over_time,
// failures, provenance.
std::vector<CsvTable> report_tables(const nlohmann::json& report);

// Of a table in the folder.
std::string table_path(const std::string& folder, const CsvTable& table);

// Into the folder, which is made if it is not there. The names of the files. Throws
// std::runtime_error as write_file() does.
std::vector<std::string> write_tables(const std::string& folder,
                                      const std::vector<CsvTable>& tables);

}  // namespace gearpod::mc
