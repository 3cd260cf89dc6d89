// Dependence of the best feature's detection on the random inputs besides the fault size, and the
// performance of all features combined, for the terminal.
#pragma once

#include <string>

#include "analysis/reliability.hpp"

namespace gearpod::analysis {

// Text at one noise level: the combined detector compared with the best single feature; a row per
// significant random input (5 %, adjusted over the inputs) with Pd in the lowest and highest bin of
// its values and a90 at its lowest, middle and highest quantile; Sobol indices of the misses. At
// most text_width() columns.
std::string robustness_text(const Reliability& reliability, std::size_t level,
                            const DetectionRequest& request);

}  // namespace gearpod::analysis
