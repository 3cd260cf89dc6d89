// Shares of an output's variance that its independent inputs explain: first-order indices (alone,
// correlation_ratio.hpp) and total ones (alone and together with others: T. Homma, A. Saltelli,
// Reliab. Eng. Syst. Saf. 52 (1996), 1-17), the latter from a polynomial surrogate of the sample
// (polynomial_surrogate.hpp), of which they can only see what it explains. An output with noise of
// its own has indices that sum to less than 1.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "analysis/inputs/correlation_ratio.hpp"
#include "analysis/inputs/miss_sensitivity.hpp"

namespace gearpod::analysis {

struct SobolIndex {
    std::string name;
    std::string unit;
    CorrelationRatio first;
    double total = 0.0;
    // Two-sided, from the influence function over the surrogate's terms as selected; without a term
    // of the input from 0 to the surrogate's resolution.
    Interval total_bounds;
};

struct SobolIndices {
    long count = 0;                     // gearboxes it rests on
    std::vector<SobolIndex> inputs;     // falling total, then falling first-order index
    double explained = 0.0;             // adjusted R^2 of the surrogate
    double resolution = 0.0;            // share that a single term needs to be found
    int terms = 0;                      // of the surrogate
    std::vector<std::string> left_out;  // inputs that do not vary
    std::string refusal;                // why there are none, else empty
};

// `output` and every input per gearbox, finite. Refused below 100 gearboxes, for a constant output
// and for inputs whose ranks are correlated, by which a share belongs to no input alone; of more
// than 20,000 gearboxes the first ones are taken.
SobolIndices sobol_indices(std::span<const double> output, const std::vector<InputColumn>& inputs,
                           double confidence);

}  // namespace gearpod::analysis
