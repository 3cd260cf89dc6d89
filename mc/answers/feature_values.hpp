// The features' values themselves, gearbox by gearbox: what a study says that has too few healthy
// gearboxes for any threshold, as those of published figures.
#pragma once

#include <string>

#include "mc/results/row_source.hpp"

namespace gearpod::mc {

// Of the graded rows at every noise level, with the inputs that differ between them. "" where a
// feature has a threshold, and where there are more rows than one reads. `frame.detection` must be
// up to date (detect_all).
std::string feature_values_text(const Results& frame, const RowSource& rows);

}  // namespace gearpod::mc
