// Solver setting: one way to compute a study.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mc/plan/planner.hpp"

namespace gearpod::mc {

struct SolverSetting {
    Numerics numerics;  // without a tolerance
    // Keys of [numerics] that the setting chooses in addition to integrator, steps and convergence
    // tolerance, e.g. "precision".
    std::vector<std::string_view> options = {};

    bool chooses(std::string_view option) const;
    // Keys of [numerics] that the setting chooses.
    std::vector<std::string_view> keys() const;
    std::string_view integrator() const;         // as a study file spells it
    std::vector<std::string> overrides() const;  // "numerics.integrator=sdirk3", ..., for --set
    std::string text() const;                    // "sdirk3, 864 steps, converged to 1e-06"
    bool operator==(const SolverSetting&) const = default;
};

// Setting of these numerics without a tolerance.
SolverSetting own_setting(const Numerics& numerics);

// Steps of the plan with a setting. Throws SceneError if the setting is invalid for the study.
PlannedSteps steps_of(const Planner& planner, const SolverSetting& setting);

// Candidate solver settings of a study, and a deterministic model of their cost.

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
    SolverSetting setting(std::size_t index, double convergence_tolerance) const;
};
// `numerics`: those that the user gives. `beyond`: largest number of steps, as a multiple of the
// steps of an integrator's own rule.
std::vector<SolverFamily> solver_families(const Planner& planner, const Numerics& numerics,
                                          double beyond);

// Smallest number of steps of a graded grid, as a fraction of the uniform steps of the integrator's
// own rule. Used as a bound, so that hopeless grids are not made.
inline constexpr double kFewestGradedFraction = 1.0 / 8.0;

// Candidate convergence tolerances, tightest first.
const std::vector<double>& convergence_tolerances();

// Cost of one step of one gearbox according to lockstep::StepCost of the integrator. Empty for
// settings whose integrator is not given, and for those that choose the strategy of integration.
std::optional<double> step_cost(const SolverFacts& facts, const SolverSetting& setting);

}  // namespace gearpod::mc
