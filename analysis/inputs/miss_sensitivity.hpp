// Which random input decides the misses: for every input, the probability that a missed gearbox has
// a larger value of it than a detected one of the same fault size (the Mann-Whitney statistic, i.e.
// the AUC of the input between misses and hits). 1/2: no influence; 1: misses are those with large
// values. The sizes are strata, weighted as P. van Elteren, Bull. Inst. Int. Stat. 37 (1960),
// 351-361, so that the fault size itself, which decides most, is out of it. The measure sees
// monotone influence only, on its own and not in interaction; it takes the sample as it is, without
// further runs or a model.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "analysis/statistics/interval.hpp"

namespace gearpod::analysis {

struct InputColumn {
    std::string name;
    std::string unit;
    std::span<const double> values;  // one a gearbox
};

struct InputInfluence {
    std::string name;
    std::string unit;
    double larger_in_misses = 0.5;
    Interval bounds;       // two-sided; DeLong's variance, on the logit scale
    double p_value = 1.0;  // of 1/2, adjusted over the inputs (Holm)
};

struct MissSensitivity {
    long misses = 0, hits = 0;             // that it rests on
    double smallest = 0.0, largest = 0.0;  // fault sizes that it rests on
    std::vector<InputInfluence> inputs;    // falling distance from 1/2
    std::vector<std::string> left_out;     // inputs that do not vary
    std::string refusal;                   // why there is none, else empty
};

// `sizes` and `hit` per gearbox (1 detected, 0 missed, -1 no value). Counts fault sizes at which
// half or more of the gearboxes, but not all, are detected, where the misses are of interest; sizes
// that do not repeat are put into strata of 100 neighbours. Strata need two of each, all together
// ten.
MissSensitivity miss_sensitivity(std::span<const double> sizes, std::span<const int> hit,
                                 const std::vector<InputColumn>& inputs, double confidence);

}  // namespace gearpod::analysis
