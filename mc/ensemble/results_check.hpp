// Checks that a results file holds what a run writes. The checksum of a file detects only
// accidental changes.
#pragma once

#include <optional>
#include <string>

#include "mc/results/result_rows.hpp"

namespace gearpod::mc {

// Expected contents of the results of a study.
struct ExpectedResults {
    Results frame;
    BatchPlan plan;
    const char* command = "run";
    bool nan_parameters_allowed = false;  // true if columns of /instances may be NaN
};
// Same check as check_results(), against given expected contents. `expected` is empty for a study
// that this program cannot read.
void check_against(const std::string& path, const Results& frame, const RowSource& rows,
                   const std::optional<ExpectedResults>& expected);

// Throws std::runtime_error naming the file and the first problem: values that no run writes, or
// datasets that do not belong to the study in the file. A study of another version that this
// program cannot read is not compared. Reads the rows once.
void check_results(const std::string& path, const Results& frame, const RowSource& rows);

}  // namespace gearpod::mc
