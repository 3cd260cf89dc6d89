// Upper median: the larger of the two middle values when the count is even.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace gearpod::machine {

// Upper median of at least one value.
inline double upper_median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace gearpod::machine
