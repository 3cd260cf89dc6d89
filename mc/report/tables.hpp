// Tables of a report as CSV files. Column names contain units; a missing number is an empty field.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace gearpod::mc {

struct CsvTable {
    std::string name;  // file name without .csv
    std::vector<std::string> columns;
    std::vector<std::string> rows;  // joined fields, without end of line
};

// Returns the tables of report_json()'s JSON that have rows: detection, smallest_fault, pod,
// pod_band, roc, ranking, misses, sensitivity, inputs, a90_by_input, combined, conditions,
// numerical, over_time, failures, provenance.
std::vector<CsvTable> report_tables(const nlohmann::json& report);

// Path of a table in the folder.
std::string table_path(const std::string& folder, const CsvTable& table);

// Writes the tables into the folder, which it creates if necessary. Returns the file names. Throws
// std::runtime_error like write_file().
std::vector<std::string> write_tables(const std::string& folder,
                                      const std::vector<CsvTable>& tables);

}  // namespace gearpod::mc
