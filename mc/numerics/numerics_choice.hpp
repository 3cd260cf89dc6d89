// Numerics that were chosen on pilot gearboxes, and the error with which they were.
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
    double cost = 0.0;  // of integrating the pilot by the cost model, in rk4 steps per gearbox
    int gearboxes = 0;  // number of pilot gearboxes

    std::string text() const;
};

// Chooses steps and selective mass scaling for numerics.scatter_tolerance: the fewest steps per
// mesh period with which no feature changes by more than that share of its scatter.

// Numerics with at most this many steps per mesh period, apart from those at contact transitions,
// and the highest limit of the mass scaling found that allows them; empty if none does. `own`:
// central differences without mass scaling. Throws SceneError if it cannot be used.
std::optional<Numerics> scaled_numerics(const Scene& own, int steps);

// Integrates the first sixteen healthy gearboxes of the study, with the steps of the integrator's
// own rule and with fewer steps and more mass scaling. If the study gives both, they are the only
// candidate. Depends on the study only. Throws SceneError if the study gives one of them, or both
// and they do not keep the tolerance.
NumericsChoice choose_by_scatter(const Study& study);

// Chooses the numerics for numerics.tolerance: the least expensive candidate setting that keeps
// every feature of a pilot within the tolerance. choose_by_scatter() serves
// numerics.scatter_tolerance.

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
