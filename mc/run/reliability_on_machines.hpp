// Assesses the features of a run on all its machines. The first rank of each machine evaluates a
// share of the pairs of a feature and a noise level, on the processors of the machine's ranks,
// which are idle after the last batch.
#pragma once

#include <optional>
#include <string>

#include "analysis/reliability.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/results/row_source.hpp"

namespace gearpod::mc {

// Called by rank 0 while the other ranks are in assess_for_leader(). Result and errors as in
// reliability_of(), whatever the number of machines. A share that another machine could not
// evaluate is evaluated here.
std::optional<analysis::Reliability> reliability_on_machines(const Results& frame,
                                                             const RowSource& rows,
                                                             const Ranks& ranks, int threads);

// Evaluates shares until rank 0 broadcasts something else (Ranks::from_leader), and returns that.
std::string assess_for_leader(const Study& study, const Ranks& ranks);

// Threads of all ranks on this machine, or its processors if there are fewer.
int threads_of_machine(const Study& study, const Ranks& ranks);

}  // namespace gearpod::mc
