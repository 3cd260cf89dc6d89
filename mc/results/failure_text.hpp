// Explains the status of a gearbox in words.
#pragma once

#include "mc/results/results_file.hpp"

namespace gearpod::mc {

// Predicate of a sentence about a gearbox with this status, for example "is unstable ...".
const char* failure_text(Status status);

}  // namespace gearpod::mc
