// Kinds of fault that a study can have.
#pragma once

#include <span>

#include "mc/study/faults/fault_kind.hpp"

namespace gearpod::mc {

// All kinds, in the order in which their keys are shown.
std::span<const FaultKind* const> all_faults();

// Kind of fault that defines the size key: the study's own, or the first kind (with size 0) for a
// study without a fault.
const FaultKind& size_defining_kind(const Study& study);

}  // namespace gearpod::mc
