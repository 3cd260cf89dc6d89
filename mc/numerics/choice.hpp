// Chooses the numerics for numerics.tolerance: the least expensive candidate setting that keeps
// every feature of a pilot within the tolerance. For numerics.scatter_tolerance see
// scatter_choice.hpp.
#pragma once

#include <optional>
#include <string>

#include "mc/numerics/solver_setting.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

struct NumericsChoice {
    SolverSetting setting;
    // Relative error of the pilot's worst feature, or its error over the feature's scatter.
    double error = 0.0;
    bool of_scatter = false;    // true for the latter
    std::string worst_feature;  // name of that feature
    double cost = 0.0;      // of integrating the pilot by the cost model, in rk4 steps per gearbox
    std::string reference;  // reference solution of the pilot
    double reference_change = 0.0;  // of its worst feature when its steps were last halved
    int gearboxes = 0;              // number of pilot gearboxes
    int integrations = 0;           // number of pilot integrations needed for the choice

    std::string text() const;
};

// Study with resolved numerics, and how they were chosen; `choice` is empty without a tolerance.
struct ResolvedStudy {
    Study study;
    std::optional<NumericsChoice> choice;
};
// Depends on the study only, not on timing, lanes, threads or instruction set. Throws SceneError if
// no candidate keeps the tolerance.
ResolvedStudy resolve_numerics(Study study);

}  // namespace gearpod::mc
