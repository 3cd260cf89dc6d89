// Properties that must agree for two runs to produce the same gearboxes, row by row.
#pragma once

#include <string>

#include "mc/results/batch_rows.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

struct RunIdentity {
    std::string version;  // version_text()
    std::string seed;
    std::string study;  // resolved, without settings that do not affect the rows
    RowShape shape;
    std::string part = {};  // Part::text()
};

// Omits the title, the number of test gearboxes, the stopping rule, and all settings of threads,
// lanes, instruction set and checkpoints.
RunIdentity run_identity(const Study& study, const RowShape& shape, const Part& part = {});

// Reason why a file of the run `there` cannot be continued as `here`, or "". One line, to follow
// the file's name.
std::string difference(const RunIdentity& there, const RunIdentity& here);

// First line in which two texts differ, as `"a" there, "b" here`; "" if there is none.
std::string line_difference(const std::string& there, const std::string& here,
                            const std::string& where_there = "there");

}  // namespace gearpod::mc
