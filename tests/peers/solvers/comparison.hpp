// Error of a solver's records: signals and features computed as from the program's own integration,
// against the converged reference.
#pragma once

#include <vector>

#include "mc/numerics/reference.hpp"
#include "peer_runs.hpp"

namespace gearpod::peers {

// Error of the features of gearboxes first to last - 1 from the records, against those of
// `reference`. The records contain the fault's whole pattern.
mc::PilotError error_of(const mc::Study& study, const std::vector<lockstep::MeshRecord>& records,
                        int first, int last, const mc::PilotRecord& reference);

// Reference reduced to those gearboxes.
mc::PilotRecord some_of(const mc::PilotRecord& all, int first, int last);

}  // namespace gearpod::peers
