// What a run says at its end, beside its detection rates.
#pragma once

#include "mc/ensemble.hpp"

namespace gearpod::mc {

// Rows that have a value.
struct RowCounts {
    std::size_t all = 0, diverged = 0, not_settled = 0;

    std::size_t failed() const { return diverged + not_settled; }
};

void print_failures(const RowCounts& rows, int max_meshes);

// Where the time went: of the threads of all ranks, and the least, mean and most of a rank.
void print_times(const EnsembleOutcome& outcome);

}  // namespace gearpod::mc
