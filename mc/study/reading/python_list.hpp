// Reads the list of Python files with features in a study file.
#pragma once

#include <vector>

#include "features/feature.hpp"
#include "mc/study/elements/list_element.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

// Features of a list of files, or of tables that resolved_text() writes. A file is run to find its
// features, and its path is relative to the folder of the study. A table is taken as it is, so that
// results can be read without the file.
// Files are refused unless `runs` is true.
std::vector<PythonFeature> read_python_features(const Value& list, bool runs,
                                                const RejectElement& reject);

// Parameters of the function, "record, baselines".
std::string_view uses_text(const features::Feature& feature);

}  // namespace gearpod::mc
