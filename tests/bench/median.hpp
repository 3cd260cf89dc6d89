// Median of a list of measurements.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace gearpod::bench {

// Upper median: the larger of the two middle values when the count is even. Requires at least one
// value.
inline double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace gearpod::bench
