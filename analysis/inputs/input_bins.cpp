#include "analysis/inputs/input_bins.hpp"

#include <algorithm>
#include <numeric>

namespace gearpod::analysis {

InputBins equal_count_bins(std::span<const double> values, std::size_t bins) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
    std::size_t distinct = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        distinct += i == 0 || values[order[i]] != values[order[i - 1]] ? 1 : 0;
    }
    const bool each = distinct <= bins;
    InputBins result;
    result.of.resize(values.size());
    std::size_t last_share = 0;
    for (std::size_t first = 0; first < order.size();) {
        std::size_t end = first;
        while (end < order.size() && values[order[end]] == values[order[first]]) {
            ++end;
        }
        // Equal values share the bin of the middle one.
        const std::size_t share = (first + end - 1) * bins / (2 * order.size());
        if (result.bins == 0 || each || share != last_share) {
            ++result.bins;
        }
        last_share = share;
        for (; first < end; ++first) {
            result.of[order[first]] = result.bins - 1;
        }
    }
    return result;
}

}  // namespace gearpod::analysis
