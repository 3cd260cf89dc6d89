// The features of an ensemble, assessed as detectors.
#pragma once

#include <optional>
#include <string>

#include "analysis/reliability.hpp"
#include "analysis/report/subject.hpp"
#include "mc/results/row_source.hpp"

namespace gearpod::mc {

// POD curves, areas and ranking need all values at once: gearboxes x features x noise levels, some
// 130 MB of them and about as much again at work. Larger ensembles have detection rates only.
inline constexpr std::size_t kMostAssessedValues = std::size_t{1} << 24;

// `frame.detection` must be up to date (detect_all). `condition`: name of a parameter whose values
// get thresholds of their own, "" for none; std::runtime_error names the parameters if it is
// unknown. None beyond `most_values`. With `costs` also the threshold of least expected cost.
std::optional<analysis::Reliability> reliability_of(const Results& frame, const RowSource& rows,
                                                    const std::string& condition, int threads,
                                                    std::size_t most_values = kMostAssessedValues,
                                                    std::optional<analysis::Costs> costs = {});

// What a results file's rows are.
analysis::Subject subject_of(const Results& frame);

// As the terminal shows it, or why there is none.
std::string reliability_text(const std::optional<analysis::Reliability>& reliability,
                             const Results& frame);

}  // namespace gearpod::mc
