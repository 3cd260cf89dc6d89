// Influence of the random inputs on misses. For every input, the probability that a missed gearbox
// has a larger value of it than a detected one of the same fault size: the Mann-Whitney statistic,
// i.e. the AUC of the input between misses and hits. 1/2 means no influence; 1 means that the
// misses are those with large values. The sizes are strata, weighted as in P. van Elteren, Bull.
// Inst. Int. Stat. 37 (1960), 351-361, which removes the dominant influence of the fault size
// itself. The measure detects only the monotone influence of single inputs, not interactions. It
// uses the sample as it is, without further runs or a model.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "analysis/statistics/interval.hpp"
#include "machine/fields.hpp"

namespace gearpod::analysis {

struct InputColumn {
    std::string name;
    std::string unit;
    std::span<const double> values;  // one per gearbox
};

// True if the values are not all equal.
inline bool varies(std::span<const double> values) {
    return std::ranges::any_of(values, [&](double value) { return value != values.front(); });
}

struct InputInfluence {
    std::string name;
    std::string unit;
    double larger_in_misses = 0.5;
    Interval bounds;       // two-sided; DeLong's variance, on the logit scale
    double p_value = 1.0;  // test against 1/2, adjusted over the inputs (Holm)
};
GEARPOD_FIELDS(InputInfluence, name, unit, larger_in_misses, lower_upper, p_value)

struct MissSensitivity {
    long misses = 0, hits = 0;             // numbers used
    double smallest = 0.0, largest = 0.0;  // range of the fault sizes used
    std::vector<InputInfluence> inputs;    // by falling distance from 1/2
    std::vector<std::string> left_out;     // inputs that do not vary
    std::string refusal;                   // reason why there is no result, or ""
};
GEARPOD_FIELDS(MissSensitivity, misses, hits, smallest, largest, inputs, left_out, refusal)

// `sizes` and `hit` per gearbox (1 detected, 0 missed, -1 no value). Uses fault sizes at which at
// least half of the gearboxes, but not all, are detected. Sizes that do not repeat are grouped into
// strata of 100 neighbours. Each stratum needs two hits and two misses, all strata together ten of
// each.
MissSensitivity miss_sensitivity(std::span<const double> sizes, std::span<const int> hit,
                                 const std::vector<InputColumn>& inputs, double confidence);

}  // namespace gearpod::analysis
