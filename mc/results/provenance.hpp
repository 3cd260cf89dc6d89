// What made a result: code, compiler, machine, study.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mc/study/study.hpp"

namespace gearpod::mc {

// "gearpod 0.3.0 (git 0123abc)".
std::string version_text();

// The same of a results file's attributes code_version and git_hash.
std::string version_text(const std::string& code_version, const std::string& git_hash);

// version_text(), and below it a line each: compiler, what the kernels were built for, HDF5.
std::string build_text();

// Root attributes of a results file, in order. `threads` are those of all ranks.
std::vector<std::pair<std::string, std::string>> provenance(const Study& study, int ranks,
                                                            int threads);

// This machine's name.
std::string host_name();

}  // namespace gearpod::mc
