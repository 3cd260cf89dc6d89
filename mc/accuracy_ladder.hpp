// The ladder of ways to march a study, and what each costs by a model that knows no clock.
#pragma once

#include <string>
#include <vector>

#include "mc/accuracy_rung.hpp"

namespace gearpod::mc {

// Ways that differ in their steps only, cheapest first. A study that names an integrator, or gives
// the steps, has no others.
struct Flight {
    std::string integrator;
    std::vector<std::string> other;  // overrides besides integrator, steps and settling
    std::vector<int> steps;          // ascending
    int own_steps = 0;               // by the integrator's own rule
    std::string refusal;             // why it has no place in this study; then there are no steps
};
// `beyond`: up to so many times the steps of an integrator's own rule.
std::vector<Flight> flights(const Study& study, double beyond);

// Tightest first.
const std::vector<double>& settle_tolerances();

// Cost of one step of one gearbox in a full tile, in the time that one step of rk4 takes: the
// ratios that `accuracy` measures, as they were on an AVX-512 core. A table and no clock, so that a
// study makes the same choice on every machine.
double step_cost(const Study& study, const std::string& integrator,
                 const std::vector<std::string>& other);

}  // namespace gearpod::mc
