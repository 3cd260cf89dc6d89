// Valid and degenerate results for tests of the report, without a simulation.
#pragma once

#include <string>
#include <vector>

#include "mc/results/results_file.hpp"

namespace gearpod::tests {

struct ReportCase {
    std::string name;
    mc::Results results;  // with detection
};

// Cases of every kind. Size of the study: the usual; no rows, no features, no fault, no healthy
// gearboxes, all failed, few. Features: constant, not a number, always or never beyond the
// threshold. Sizes and noise: no noise, one size, a continuous size, a size that is a pure number.
// Others: more features and noise levels than the page has colours; an interrupted run.
std::vector<ReportCase> report_cases();

}  // namespace gearpod::tests
