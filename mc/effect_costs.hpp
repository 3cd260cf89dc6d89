// What the effects of a scene cost, as shares of a plain step.
#pragma once

#include <string>
#include <vector>

#include "mc/study.hpp"

namespace gearpod::mc {

struct EffectCost {
    std::string effect;
    double share = 0.0;  // of the time of a step of the same gearbox without any of them
};

// Of the effects that the study has and that add to a step. Measured by tests/bench/bench_effects
// (README.md there): the effects' times add up to within some hundredths. Empty where nothing is
// stepped.
std::vector<EffectCost> effect_costs(const Study& study);

}  // namespace gearpod::mc
