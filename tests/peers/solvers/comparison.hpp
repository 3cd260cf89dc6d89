// What a solver's records are worth: the same signals and features as the program makes of its own
// march, against the converged reference.
#pragma once

#include <vector>

#include "mc/numerics/reference.hpp"
#include "peer_runs.hpp"

namespace gearpod::peers {

// The features that the records give of gearboxes first to last - 1, against those of `reference`.
// The records are the fault's whole pattern.
mc::PilotError error_of(const mc::Scene& scene, const std::vector<lockstep::MeshRecord>& records,
                        int first, int last, const mc::PilotRecord& reference);

// A reference with those gearboxes alone.
mc::PilotRecord some_of(const mc::PilotRecord& all, int first, int last);

}  // namespace gearpod::peers
