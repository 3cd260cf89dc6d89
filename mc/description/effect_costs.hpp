// What the effects of a scene cost, as shares of a plain step.
#pragma once

#include <string>
#include <vector>

#include "mc/study/study.hpp"

namespace gearpod::mc {

struct EffectCost {
    std::string effect;
    double share = 0.0;  // of the time of an rk4 step of the same gearbox without any of them
};

// Of the effects that the study has and that add to a step. Measured by tests/bench/bench_effects
// (README.md there): the shares of several effects add up to within a tenth of the step. Empty
// where nothing is stepped. Path, noise, tones and encoders work on signals, not in steps.
std::vector<EffectCost> effect_costs(const Study& study);

}  // namespace gearpod::mc
