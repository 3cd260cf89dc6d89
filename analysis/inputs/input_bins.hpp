// Division of an input's values into bins of equal counts.
#pragma once

#include <span>
#include <vector>

namespace gearpod::analysis {

// Bin of each value, 0 to bins - 1 in ascending order of the values. With at most `bins` distinct
// values, each has its own bin. Otherwise equal values share a bin and the counts are as equal as
// that allows. Values must be finite.
struct InputBins {
    std::vector<std::size_t> of;
    std::size_t bins = 0;
};
InputBins equal_count_bins(std::span<const double> values, std::size_t bins);

}  // namespace gearpod::analysis
