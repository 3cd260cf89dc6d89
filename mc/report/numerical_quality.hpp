// Failed gearboxes of a run by reason, and features without a value.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "analysis/report/report.hpp"
#include "mc/numerics/numerical_error.hpp"
#include "mc/results/result_rows.hpp"

namespace gearpod::mc {

// Number of gearboxes by status. `diverged` counts every failure except those that did not converge
// to the periodic steady state.
struct RowCounts {
    std::size_t all = 0, diverged = 0, not_converged = 0;
    std::array<std::size_t, kStatuses> with_status{};

    std::size_t failed() const { return diverged + not_converged; }
};

// Counts gearboxes. `records`: rows of each threshold gearbox
// (DetectionRequest::threshold_records); only the first one counts.
RowCounts count_rows(const RowSource& rows, std::size_t records);

struct Failures {
    RowCounts counts;
    std::vector<std::pair<std::size_t, int>> first;  // at most 20: row, status
    std::vector<std::vector<long>> no_value;         // by feature and noise level, without failures
};

Failures failures_of(const Results& frame, const RowSource& rows);

// Failed gearboxes with their reasons; on the screen if there are any.
analysis::Section failures_section(const Results& frame, const Failures& failures);

// docs/reference/report-json.md lists the keys.
nlohmann::json failures_json(const Results& frame, const Failures& failures);

// Numerical error of a run as a section of its report.

// The error of the time steps where teeth lose contact, and the numerical error next to the
// statistical one; each only if it was estimated.
analysis::Section numerical_section(const Results& frame,
                                    const std::vector<NumericalContribution>& contributions);

// Both errors of a feature's detection rate at a noise level; "" if they are not known.
std::string numerical_limit(const std::vector<NumericalContribution>& contributions,
                            const std::string& feature, double noise_level);

}  // namespace gearpod::mc
