// Whether a results file is what a run writes: its seal only says that nobody changed it by
// accident.
#pragma once

#include <optional>
#include <string>

#include "mc/results/row_source.hpp"

namespace gearpod::mc {

// What a study's own results are.
struct ExpectedResults {
    Results frame;
    BatchPlan plan;
    const char* command = "run";
    bool open_instances = false;  // columns of /instances may be NaN
};
// As below; none: of a study that this program cannot read.
void check_like(const std::string& path, const Results& frame, const RowSource& rows,
                const std::optional<ExpectedResults>& expected);

// Throws std::runtime_error naming the file and the first thing that does not fit: numbers that no
// run writes, or datasets that are not those of the study that the file holds. A study that this
// program cannot read (another version's) is not compared. One pass over the rows.
void check_results(const std::string& path, const Results& frame, const RowSource& rows);

}  // namespace gearpod::mc
