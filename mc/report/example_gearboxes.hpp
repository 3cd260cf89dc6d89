// Two example gearboxes of a results file, one healthy and one with the largest fault. They are
// computed again to show the signals from which features are computed, and the mesh stiffness.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "mc/results/result_rows.hpp"

namespace gearpod::mc {

// Returns {"examples": {"refusal", "noise_level", "gearboxes": [...]}, "stiffness": {"refusal",
// ...}} for the study stored in the file (docs/reference/report-json.md lists the keys). The
// gearboxes are the first rows with values of size 0 and of the largest size. `refusal` is the
// reason why there are none, or null. Signals and spectra are thinned for plotting.
nlohmann::json examples_json(const Results& frame, const RowSource& rows);

}  // namespace gearpod::mc
