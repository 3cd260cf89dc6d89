// Sobol indices: shares of an output's variance that its independent inputs explain. First-order
// indices (input alone) follow correlation_ratio.hpp. Total indices (alone and in interaction with
// others: T. Homma, A. Saltelli, Reliab. Eng. Syst. Saf. 52 (1996), 1-17) are computed from a
// polynomial surrogate of the sample (polynomial_surrogate.hpp), so they include only what it
// explains. For an output with noise of its own, the indices sum to less than 1.
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
    // Two-sided bounds from the influence function over the selected terms of the surrogate. If no
    // term contains the input, from 0 to the surrogate's resolution.
    Interval total_bounds;
};

struct SobolIndices {
    long count = 0;                     // number of gearboxes used
    std::vector<SobolIndex> inputs;     // by falling total, then first-order index
    double explained = 0.0;             // adjusted R^2 of the surrogate
    double resolution = 0.0;            // share that a single term needs to be found
    int terms = 0;                      // number of terms of the surrogate
    std::vector<std::string> left_out;  // inputs that do not vary
    std::string refusal;                // reason why there are no indices, or ""
};

// Computes the indices from `output` and every input per gearbox; all values must be finite.
// Refuses fewer than 100 gearboxes, a constant output, and inputs with correlated ranks, whose
// shares cannot be attributed to one input. Uses the first 20,000 gearboxes.
SobolIndices sobol_indices(std::span<const double> output, const std::vector<InputColumn>& inputs,
                           double confidence);

}  // namespace gearpod::analysis
