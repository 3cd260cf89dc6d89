// The ladder of ways to march a study, and what each costs by a model that knows no clock.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mc/numerics/rung.hpp"

namespace gearpod::mc {

// Ways that differ in their steps only, cheapest first: so many equal ones, or those of a graded
// grid, which a pilot makes for a tolerance. A study that names an integrator, or gives the steps,
// has no others.
struct Flight {
    std::string integrator;
    std::vector<std::string> other;       // overrides besides integrator, steps and settling
    std::vector<int> steps;               // ascending
    std::vector<double> grid_tolerances;  // descending; then there are no steps
    int own_steps = 0;                    // equal ones, by the integrator's own rule
    std::string refusal;                  // why it has no place in this study; then it is empty

    bool graded() const { return !grid_tolerances.empty(); }
    std::size_t size() const { return graded() ? grid_tolerances.size() : steps.size(); }
    Rung rung(std::size_t place, double settle_tolerance) const;
};
// `beyond`: up to so many times the steps of an integrator's own rule.
std::vector<Flight> flights(const Study& study, double beyond);

// A graded grid has hardly fewer steps than this share of the equal ones that an integrator's own
// rule takes: beyond it none is made to find out.
inline constexpr double kFewestGraded = 1.0 / 8.0;

// Tightest first.
const std::vector<double>& settle_tolerances();

// Cost of one step of one gearbox by what the integrator says of itself (lockstep::StepCost).
// Nothing for ways that have no known cost: those are measured, but not chosen.
std::optional<double> step_cost(const Study& study, const std::string& integrator,
                                const std::vector<std::string>& other);

}  // namespace gearpod::mc
