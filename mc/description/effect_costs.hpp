// Computing time of physical effects, relative to a time step without them.
#pragma once

#include <string>
#include <vector>

#include "mc/study/study.hpp"

namespace gearpod::mc {

struct EffectCost {
    std::string effect;
    double share = 0.0;  // fraction of the time of an rk4 step of the same gearbox without effects
};

// Costs of the study's effects that make a time step longer. Measured by tests/bench/bench_effects
// (README.md there); the costs of several effects add up to within a tenth of the step. Empty
// for quasi-static studies. Path, noise, tones and encoders act on signals, not in time steps.
std::vector<EffectCost> effect_costs(const Study& study);

}  // namespace gearpod::mc
