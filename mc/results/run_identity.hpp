// What must agree for two runs to give the same gearboxes, row by row.
#pragma once

#include <string>

#include "mc/results/batch_rows.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

struct RunIdentity {
    std::string version;  // version_text()
    std::string seed;
    std::string study;  // resolved, without what leaves the rows as they are
    RowShape shape;
    std::string part = {};  // Part::text(): whose rows there are
};

// Left out are the title, the number of graded gearboxes, when to stop, and everything about
// threads, lanes, instruction set and checkpoints.
RunIdentity run_identity(const Study& study, const RowShape& shape, const Part& part = {});

// Why `there`, found in a file, cannot continue as `here`, or "". One line, to follow the file's
// name.
std::string difference(const RunIdentity& there, const RunIdentity& here);

// The first line in which two texts differ, as `"a" there, "b" here`; "" if none.
std::string line_difference(const std::string& there, const std::string& here,
                            const std::string& where_there = "there");

}  // namespace gearpod::mc
