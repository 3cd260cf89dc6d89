#include "analysis/detection/reliable_size.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/statistics/interval.hpp"

namespace gearpod::analysis {

std::optional<SizeGroup> reliable_size(const LevelDetection& level, double pd) {
    std::optional<SizeGroup> size;
    for (auto cell = level.cells.rbegin(); cell != level.cells.rend(); ++cell) {
        if (cell->size.high <= 0.0 || !(cell->lower >= pd)) {
            break;
        }
        size = cell->size;
    }
    return size;
}

long hits_in_a_row(double pd, double confidence) {
    return static_cast<long>(std::ceil(std::log1p(-confidence) / std::log(pd) - 1e-9));
}

double size_beyond_misses(std::span<const double> sizes, std::span<const int> hit, double pd,
                          double confidence) {
    double missed = 0.0;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        missed = hit[i] == 0 ? std::max(missed, sizes[i]) : missed;
    }
    std::vector<double> beyond;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        if (hit[i] == 1 && sizes[i] > missed) {
            beyond.push_back(sizes[i]);
        }
    }
    const auto last = static_cast<std::size_t>(hits_in_a_row(pd, confidence)) - 1;
    if (beyond.size() <= last) {
        return kNan;
    }
    std::nth_element(beyond.begin(), beyond.begin() + static_cast<std::ptrdiff_t>(last),
                     beyond.end());
    return beyond[last];
}

double demonstrated_size(const LevelDetection& level, std::span<const double> sizes,
                         std::span<const int> hit, double pd, double confidence) {
    const double single = size_beyond_misses(sizes, hit, pd, 1.0 - 0.5 * (1.0 - confidence));
    const auto group = reliable_size(level, pd);
    return group ? std::fmin(group->high, single) : single;
}

}  // namespace gearpod::analysis
