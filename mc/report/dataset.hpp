// Dataset of results for machine learning: features with labels, severity, identity of the gearbox
// and splits by gearbox (CSV), stored signals (CSV) and a data card (Markdown).
#pragma once

#include <string>
#include <vector>

#include "mc/report/tables.hpp"
#include "mc/results/row_source.hpp"

namespace gearpod::mc {

// All files: README.md, columns.csv, train.csv, validation.csv, test.csv, study.toml, and
// signals_ROW.csv for each row whose signals are stored. `file`: results file of `rows`. All rows
// of a gearbox are in one split. The split depends on the seed and the gearbox only, or on the name
// of a recorded gearbox. Failed rows are left out. Throws std::runtime_error naming the file if
// its study or its signals cannot be read.
std::vector<NamedFile> dataset_files(const Results& frame, const RowSource& rows,
                                     const std::string& file);

}  // namespace gearpod::mc
