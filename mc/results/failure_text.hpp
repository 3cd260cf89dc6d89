// What a gearbox's status says, in words.
#pragma once

#include "mc/results/results_file.hpp"

namespace gearpod::mc {

// One sentence on a gearbox of that status, without its subject: "is unstable ...".
const char* failure_text(Status status);

}  // namespace gearpod::mc
