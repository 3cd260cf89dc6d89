// Limits of an answer: detection at half and at twice each assumption of its study.
#pragma once

#include <string>

#include "analysis/report/findings/findings.hpp"
#include "mc/results/result_rows.hpp"

namespace gearpod::mc {

// "" and no rows where the results have no rows with changed assumptions (AssumptionRows).
struct AssumptionLimits {
    std::string strongest;   // sentence on the assumption that changes the answer most
    bool decides = false;    // it changes a size, or the share that is found, by more than 10 %
    std::string fine_steps;  // the same on the steps of the integration
    analysis::Table table;   // all assumptions
};
// The limits concern the best feature at the noise level of the answer, or at the next lower one at
// which a fault is found.
AssumptionLimits assumption_limits(const Results& frame, const RowSource& rows,
                                   const analysis::Findings& findings);

}  // namespace gearpod::mc
