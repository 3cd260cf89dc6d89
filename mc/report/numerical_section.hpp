// Numerical error of a run as a section of its report.
#pragma once

#include <string>
#include <vector>

#include "analysis/report/report.hpp"
#include "mc/numerics/numerical_error.hpp"

namespace gearpod::mc {

// The error of the time steps where teeth lose contact, and the numerical error next to the
// statistical one; each only if it was estimated.
analysis::Section numerical_section(const Results& frame,
                                    const std::vector<NumericalContribution>& contributions);

// Both errors of a feature's detection rate at a noise level; "" if they are not known.
std::string numerical_limit(const std::vector<NumericalContribution>& contributions,
                            const std::string& feature, double noise_level,
                            const analysis::SizeUnit& unit);

}  // namespace gearpod::mc
