// The middle one of some measurements.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace gearpod::bench {

// Of an even number the larger of the two in the middle; not of none.
inline double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace gearpod::bench
