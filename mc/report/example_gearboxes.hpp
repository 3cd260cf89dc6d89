// Two gearboxes of a results file computed again: a healthy one and one with the largest fault,
// with the signals that their features look at, and the stiffness of their teeth.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "mc/results/row_source.hpp"

namespace gearpod::mc {

// The noise level that a report shows first: 1 if the study has it, else the smallest above 0,
// else the first.
std::size_t reference_level(const std::vector<double>& noise_levels);

// {"examples": {"refusal", "noise_level", "gearboxes": [...]}, "stiffness": {"refusal", ...}} from
// the study that the file holds; the keys are those of mc/README.md. The gearboxes are the first
// rows of size 0 and of the largest size that have values. `refusal` says why there are none, null
// if there are.
nlohmann::json examples_json(const Results& frame, const RowSource& rows);

}  // namespace gearpod::mc
