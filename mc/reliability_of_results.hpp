// The features of a results file, assessed as detectors.
#pragma once

#include <string>

#include "analysis/reliability.hpp"
#include "mc/results_file.hpp"

namespace gearpod::mc {

// `results.detection` must be up to date (detect_all). `condition`: name of a parameter whose
// values get thresholds of their own, "" for none; std::runtime_error names the parameters if it is
// unknown.
analysis::Reliability reliability_of(const Results& results, const std::string& condition);

}  // namespace gearpod::mc
