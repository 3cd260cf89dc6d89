// Upper median: the larger of the two middle values when the count is even.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "machine/contracts.hpp"

namespace gearpod::machine {

inline double upper_median(std::vector<double> values) {
    EXPECTS(!values.empty());
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace gearpod::machine
