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

// Cases of every kind: the usual; no rows, no features, no fault, no healthy gearboxes, all failed,
// few; a feature that is constant, not a number, always or never beyond its threshold; no noise,
// one size, a continuous size, a size that is a pure number; more features and noise levels than
// the page has colours; an interrupted run.
std::vector<ReportCase> report_cases();

}  // namespace gearpod::tests
