// Candidate solver settings of a study, and a deterministic model of their cost.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mc/numerics/solver_setting.hpp"

namespace gearpod::mc {

// Solver family: settings that differ only in their steps, least expensive first. Either numbers of
// uniform steps, or tolerances of a graded grid, which is made with a pilot. If the study gives an
// integrator or the steps, only those are used.
struct SolverFamily {
    SolverSetting common;                 // with the study's own steps and convergence tolerance
    std::vector<int> steps;               // ascending
    std::vector<double> grid_tolerances;  // descending; if not empty, `steps` is empty
    int own_steps = 0;                    // uniform steps by the integrator's own rule
    std::string refusal;  // why it is invalid for this study; the family is then empty

    bool graded() const { return !grid_tolerances.empty(); }
    std::size_t size() const { return graded() ? grid_tolerances.size() : steps.size(); }
    SolverSetting setting(std::size_t place, double convergence_tolerance) const;
};
// `beyond`: largest number of steps, as a multiple of the steps of an integrator's own rule.
std::vector<SolverFamily> solver_families(const Study& study, double beyond);

// Smallest number of steps of a graded grid, as a fraction of the uniform steps of the integrator's
// own rule. Used as a bound, so that hopeless grids are not made.
inline constexpr double kFewestGradedFraction = 1.0 / 8.0;

// Candidate convergence tolerances, tightest first.
const std::vector<double>& convergence_tolerances();

// Cost of one step of one gearbox according to lockstep::StepCost of the integrator. Empty for
// settings whose integrator is not given, and for those that choose the strategy of integration.
std::optional<double> step_cost(const Study& study, const SolverSetting& setting);

}  // namespace gearpod::mc
