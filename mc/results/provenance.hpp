// Provenance of a result: code, compiler, machine and study.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mc/results/result_rows.hpp"

namespace gearpod::mc {

// For example "gearpod 0.3.0 (git 0123abc)".
std::string version_text();

// The same for the attributes code_version and git_hash of a results file.
std::string version_text(const std::string& code_version, const std::string& git_hash);

// version_text(), then one line each for the compiler, the kernels, the MPI library and HDF5.
std::string build_text(const std::string& mpi);

// Root attributes of a results file, in order. `threads`: number of threads of all ranks.
std::vector<std::pair<std::string, std::string>> provenance(const EnsemblePlan& plan, int ranks,
                                                            int threads);

// Attribute of recordings' results: a line for each measured file, its SHA-256 and its name as
// sha256sum prints them.
inline constexpr const char* kRecordedFiles = "recorded_files";

// Name of this machine.
std::string host_name();

// Properties that must agree for two runs to produce the same gearboxes, row by row.

struct RunIdentity {
    std::string version;  // version_text()
    std::string seed;
    std::string study;  // EnsemblePlan::identity
    RowShape shape;
    std::string part = {};  // Part::text()
};

RunIdentity run_identity(const EnsemblePlan& plan, const RowShape& shape, const Part& part = {});

// Reason why a file of the run `there` cannot be continued as `here`, or "". One line, to follow
// the file's name.
std::string difference(const RunIdentity& there, const RunIdentity& here);

// First line in which two texts differ, as `"a" there, "b" here`; "" if there is none.
std::string line_difference(const std::string& there, const std::string& here,
                            const std::string& where_there = "there");

}  // namespace gearpod::mc
