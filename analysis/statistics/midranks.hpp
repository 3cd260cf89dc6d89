// Ranks from 1; tied values share their mean rank.
#pragma once

#include <span>
#include <vector>

namespace gearpod::analysis {

std::vector<double> midranks(std::span<const double> values);

}  // namespace gearpod::analysis
