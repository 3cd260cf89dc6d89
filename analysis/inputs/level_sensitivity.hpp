// Influence of the random inputs on whether a feature finds a fault: Sobol indices of its misses
// and of its value over the faulty gearboxes of sizes at which detection is neither certain nor
// impossible. The fault size is one of the inputs.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "analysis/detection/detection.hpp"
#include "analysis/inputs/sobol_indices.hpp"

namespace gearpod::analysis {

struct LevelSensitivity {
    std::string feature;
    SizeGroup sizes;      // NaN if there are none
    SobolIndices misses;  // of the outcome missed or detected
    SobolIndices values;  // of the normal score of the value, so that no tail dominates
};

// `values` of the feature at one noise level and `hit` (outcomes()) per gearbox; `size` is the
// column of fault sizes.
LevelSensitivity level_sensitivity(const std::string& feature, std::span<const double> values,
                                   const std::vector<int>& hit, const InputColumn& size,
                                   const std::vector<InputColumn>& inputs,
                                   const LevelDetection& detection, double confidence);

}  // namespace gearpod::analysis
