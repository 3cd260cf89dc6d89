// The kinds of fault that a study can have.
#pragma once

#include <span>
#include <string_view>

#include "mc/study/faults/fault_kind.hpp"

namespace gearpod::mc {

// In the order in which their keys are shown.
std::span<const FaultKind* const> all_faults();

// nullptr if there is none of this name.
const FaultKind* find_fault(std::string_view name);

// The study's kind of fault; a study without one has the sizes of the first kind, all of them 0.
const FaultKind& sized_as(const Study& study);

}  // namespace gearpod::mc
