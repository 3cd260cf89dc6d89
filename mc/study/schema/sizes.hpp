// The fault sizes of a study, and the detection rates it asks for.
#pragma once

#include <string>
#include <vector>

#include "analysis/detection/detection.hpp"
#include "mc/study/schema/schema.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

// The key that holds the size of the study's kind of fault: depth, stage, chip, ... Without a fault
// the crack depth, which is then 0.
const Key& fault_size_key(const Study& study);

// The nominal size, SI; 0 without a fault or where only [random] says it.
double fault_size(const Study& study);
void set_fault_size(Study& study, double size);

// The column of the sizes in the results, "fault_depth_m".
std::string fault_size_column(const Study& study);

// Edges of the size groups, SI, whether lengths or pure numbers; the key that gives them.
const std::vector<double>& size_edges(const Study& study);
std::string size_edges_key(const Study& study);

// Ascending and distinct. Levels, a constant or a nominal size: one group each, low = high, in
// exactly the values that the sampler gives. A continuous size: between size_edges(). One group at
// 0 without a fault.
std::vector<analysis::SizeGroup> size_groups(const Study& study);

// A fault size in the unit of its key (mm) in the unit of the groups.
double size_in_si(const Study& study, double in_file);
// "3 mm", "2 to 3 mm", "0.1".
std::string size_text(const Study& study, const analysis::SizeGroup& group);

analysis::DetectionRequest detection_request(const Study& study);

// The sizes whose stiffness curves show the study: the levels, or the edges, without 0. Ascending,
// SI.
std::vector<double> fault_sizes(const Study& study);

}  // namespace gearpod::mc
