// Chooses the numerics for numerics.tolerance: the least expensive candidate setting that keeps
// every feature of a pilot within the tolerance. For numerics.scatter_tolerance see
// scatter_choice.hpp.
#pragma once

#include <optional>

#include "mc/numerics/numerics_choice.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

// Study with resolved numerics, and how they were chosen; `choice` is empty without a tolerance.
struct ResolvedStudy {
    Study study;
    std::optional<NumericsChoice> choice;
};
// Depends on the study only, not on timing, lanes, threads or instruction set. Throws SceneError if
// no candidate keeps the tolerance.
ResolvedStudy resolve_numerics(Study study);

// The study with its own numerics, not those that a tolerance would choose.
Study without_tolerance(Study study);

}  // namespace gearpod::mc
