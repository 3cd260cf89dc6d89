// Table of feature values for each gearbox. It replaces the detection rates if a study has too few
// healthy gearboxes for any threshold, such as the studies of published figures.
#pragma once

#include "analysis/report/report.hpp"
#include "mc/results/row_source.hpp"

namespace gearpod::mc {

// Returns the values of the test rows at every noise level, with the inputs that differ between
// the rows. Empty if a feature has a threshold, or if there are more than 60 rows.
// `frame.detection` must be up to date (detect_all).
analysis::Section feature_values(const Results& frame, const RowSource& rows);

}  // namespace gearpod::mc
