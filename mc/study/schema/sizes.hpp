// Fault sizes of a study, and the detection rates that it requests.
#pragma once

#include <string>
#include <vector>

#include "analysis/detection/detection.hpp"
#include "mc/study/schema/schema.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

// Key of the size of the study's kind of fault: depth, stage, chip width, ... Without a fault, the
// crack depth, which is then 0.
const Key& fault_size_key(const Study& study);

// Nominal size, SI; 0 without a fault or if only [random] gives it.
double fault_size(const Study& study);
void set_fault_size(Study& study, double size);

// Name of the size column in the results, e.g. "fault_depth_m".
std::string fault_size_column(const Study& study);

// Edges of the size groups, SI, whether lengths or pure numbers, and the key that gives them.
const std::vector<double>& size_edges(const Study& study);
std::string size_edges_key(const Study& study);

// Size groups, ascending and distinct. Levels, a constant or a nominal size: one group each with
// low = high, in exactly the values that the sampler uses. A continuous size: the intervals between
// size_edges(). One group at 0 without a fault.
std::vector<analysis::SizeGroup> size_groups(const Study& study);

// "3 mm", "2 to 3 mm", "0.1".
std::string size_text(const Study& study, const analysis::SizeGroup& group);

analysis::DetectionRequest detection_request(const Study& study);

// Sizes at which stiffness curves are shown: the levels, or the edges, without 0. Ascending, SI.
std::vector<double> fault_sizes(const Study& study);

}  // namespace gearpod::mc
