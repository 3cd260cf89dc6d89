// Distributes the batches of a run over its ranks. Rank 0 assigns batches in order, a few to every
// rank. A rank that has finished a batch sends its rows and gets another, so a slow rank does not
// delay the others. Only the main thread of a rank communicates; it sleeps between polls.
#pragma once

#include "mc/ensemble/ensemble_run.hpp"

namespace gearpod::mc {

// Runs the part of rank 0.
EnsembleOutcome run_leader(WorkerTeam& team, const BatchPlan& plan, const EnsembleRun& run);

// Runs the part of the other ranks; returns an empty outcome.
EnsembleOutcome run_follower(WorkerTeam& team, const EnsembleRun& run);

}  // namespace gearpod::mc
