// Tables of a report as CSV files. Column names contain units; a missing number is an empty field.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "mc/files/signal_file.hpp"

namespace gearpod::mc {

struct CsvTable {
    std::string name;  // file name without .csv
    std::vector<std::string> columns;
    std::vector<std::string> rows;  // joined fields, without end of line
};

// Returns the tables that have rows: of report_json()'s JSON features, detection, smallest_fault,
// pod, pod_band, roc, ranking, misses, inputs, a90_by_input, conditions,
// numerical, over_time, monitoring, failures, provenance; of lives_json()'s lives, trade_offs; of
// inspection_json()'s inspections, thresholds.
std::vector<CsvTable> report_tables(const nlohmann::json& report);

// File of a folder.
struct NamedFile {
    std::string name;
    std::string bytes;
};

// The tables as CSV files.
std::vector<NamedFile> table_files(const std::vector<CsvTable>& tables);

// Signals as CSV, "name [unit]" in the header; all columns have the same length.
std::string signals_csv(const std::vector<SignalColumn>& columns);

// Path of a file in the folder.
std::string path_in(const std::string& folder, const std::string& name);

// Writes the files into the folder, which it creates if necessary. Returns their paths. Throws
// std::runtime_error like write_file().
std::vector<std::string> write_files(const std::string& folder,
                                     const std::vector<NamedFile>& files);

}  // namespace gearpod::mc
