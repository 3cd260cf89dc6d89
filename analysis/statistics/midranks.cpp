#include "analysis/statistics/midranks.hpp"

#include <algorithm>
#include <numeric>

namespace gearpod::analysis {

std::vector<double> midranks(std::span<const double> values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
    std::vector<double> ranks(values.size());
    for (std::size_t first = 0; first < order.size();) {
        std::size_t last = first;
        while (last < order.size() && values[order[last]] == values[order[first]]) {
            ++last;
        }
        // Mean of the ranks first + 1 ... last.
        const double rank = 0.5 * static_cast<double>(first + 1 + last);
        for (std::size_t i = first; i < last; ++i) {
            ranks[order[i]] = rank;
        }
        first = last;
    }
    return ranks;
}

}  // namespace gearpod::analysis
