// How the ranks of a run share its batches. Rank 0 deals them out in order, a few to every rank; a
// rank that has finished one sends its rows and gets another, so that a slow rank holds nobody up.
// Only the main thread of a rank talks; it sleeps between looks and takes no time from the others.
#pragma once

#include "mc/ensemble/ensemble_run.hpp"

namespace gearpod::mc {

// Rank 0's part.
EnsembleOutcome lead(BatchCrew& crew, const BatchPlan& plan, const EnsembleRun& run);

// The other ranks' part; the outcome is empty.
EnsembleOutcome follow(BatchCrew& crew, const EnsembleRun& run);

}  // namespace gearpod::mc
