// Report of a run, and its computing times for the terminal.
#pragma once

#include <optional>

#include "analysis/reliability.hpp"
#include "analysis/report/report.hpp"
#include "mc/ensemble/ensemble.hpp"
#include "mc/results/row_source.hpp"

namespace gearpod::mc {

// Everything that a results file tells, in the order of the page. `frame.detection` must be up to
// date (detect_all). `reliability` is empty if the ensemble is too large.
analysis::Report results_report(const Results& frame, const RowSource& rows,
                                const std::optional<analysis::Reliability>& reliability);

// The answer for the end of a run: its sentence, the conditions for which it holds, and a warning
// of too few healthy gearboxes.
std::string headline_text(const analysis::Report& report);

// Prints the computing time by task, summed over all threads, with the least, mean and largest
// value of a rank.
void print_computing_times(const EnsembleOutcome& outcome);

}  // namespace gearpod::mc
