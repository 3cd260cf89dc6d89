// Text report of a run: assumptions, detection rates, failures and computing times.
#pragma once

#include <array>

#include "analysis/reliability.hpp"
#include "mc/ensemble/ensemble.hpp"
#include "mc/results/row_source.hpp"

namespace gearpod::mc {

// Number of gearboxes by status. `diverged` counts every failure except those that did not converge
// to the periodic steady state.
struct RowCounts {
    std::size_t all = 0, diverged = 0, not_converged = 0;
    std::array<std::size_t, kStatuses> with_status{};

    std::size_t failed() const { return diverged + not_converged; }
};

// Counts gearboxes. `records`: rows of each threshold gearbox
// (DetectionRequest::threshold_records); only the first one counts.
RowCounts count_rows(const RowSource& rows, std::size_t records);

// Report with assumptions, detection rates, reliability and, if it was verified, the numerical
// error.
std::string results_text(const Results& frame, const RowSource& rows,
                         const std::optional<analysis::Reliability>& reliability);

void print_failures(const RowCounts& rows, int max_meshes);

// Prints the computing time by task, summed over all threads, with the least, mean and largest
// value of a rank.
void print_computing_times(const EnsembleOutcome& outcome);

}  // namespace gearpod::mc
