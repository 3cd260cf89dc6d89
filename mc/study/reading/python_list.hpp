// Reads the list of Python files with features in a study file.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "features/feature.hpp"
#include "mc/input/document.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

// Called with a problem and a remedy.
using RejectPython = std::function<void(std::string what, std::string remedy)>;

// Features of a list of files, or of tables that resolved_text() writes. A file is run to find its
// features, and its path is relative to the folder of the study. A table is taken as it is, so that
// results can be read without the file.
// Files are refused unless `runs` is true.
std::vector<PythonFeature> read_python_features(const Value& list, bool runs,
                                                const RejectPython& reject);

// Parameters of the function, "record, baselines".
std::string_view uses_text(const features::Feature& feature);

}  // namespace gearpod::mc
