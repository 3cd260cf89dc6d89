// What the best feature's detection depends on beside the fault's size, and whether all features
// together do better, as a reader sees it in the terminal.
#pragma once

#include <string>

#include "analysis/reliability.hpp"

namespace gearpod::analysis {

// At one noise level: the combined detector beside the best single feature; a row per random input
// that matters (5 %, adjusted over the inputs) with Pd in the lowest and highest bin of its
// values and a90 at its lowest, middle and highest quantile; Sobol indices of the misses. At most
// text_width() columns.
std::string robustness_text(const Reliability& reliability, std::size_t level,
                            const DetectionRequest& request);

}  // namespace gearpod::analysis
