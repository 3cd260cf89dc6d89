// What a run says at its end, beside its detection rates.
#pragma once

#include <array>

#include "analysis/reliability.hpp"
#include "mc/ensemble/ensemble.hpp"
#include "mc/results/row_source.hpp"

namespace gearpod::mc {

// All gearboxes, and those without a value; `diverged` holds all but those that did not settle.
struct RowCounts {
    std::size_t all = 0, diverged = 0, not_settled = 0;
    std::array<std::size_t, kStatuses> with_status{};

    std::size_t failed() const { return diverged + not_settled; }
};

// `records`: rows of each gearbox that sets thresholds (DetectionRequest::threshold_records).
RowCounts count_rows(const RowSource& rows, std::size_t records);

// What the answer takes for granted, detection rates, reliability and, if it was verified, the
// numerical error.
std::string results_text(const Results& frame, const RowSource& rows,
                         const std::optional<analysis::Reliability>& reliability);

void print_failures(const RowCounts& rows, int max_meshes);

// Where the time went: of the threads of all ranks, and the least, mean and most of a rank.
void print_times(const EnsembleOutcome& outcome);

}  // namespace gearpod::mc
