// The fault sizes of a study, and the detection rates it asks for.
#pragma once

#include <string>
#include <vector>

#include "analysis/detection.hpp"
#include "mc/study.hpp"

namespace gearpod::mc {

// Ascending and distinct. Levels, a constant or a nominal depth: one group each, low = high, in
// exactly the values that the sampler gives. A continuous depth: between the edges of
// detection.size_edges_mm. One group at 0 without a fault.
std::vector<analysis::SizeGroup> size_groups(const Study& study);

// A fault size in the unit of its key (mm) in the unit of the groups.
double size_in_si(double in_file);
// "3 mm", "2 to 3 mm".
std::string size_text(const analysis::SizeGroup& group);

analysis::DetectionRequest detection_request(const Study& study);

// The depths whose stiffness curves show the study: the levels, or the edges, without 0. Ascending,
// m.
std::vector<double> fault_depths_m(const Study& study);

}  // namespace gearpod::mc
