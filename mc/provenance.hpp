// What made a result: code, compiler, machine, study.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mc/study.hpp"

namespace gearpod::mc {

// "gearpod 0.1.0 (git 0123abc)".
std::string version_text();

// Root attributes of a results file, in order.
std::vector<std::pair<std::string, std::string>> provenance(const Study& study);

}  // namespace gearpod::mc
