#include "analysis/size_groups.hpp"

#include <cmath>

namespace gearpod::analysis {

std::optional<std::size_t> group_of(double size, const std::vector<SizeGroup>& groups) {
    constexpr double kSameSize = 1e-9;
    std::optional<std::size_t> found;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const double slack = kSameSize * std::abs(groups[g].high);
        const bool level = groups[g].low == groups[g].high;
        const double low = level ? groups[g].low - slack : groups[g].low;
        const double high = level ? groups[g].high + slack : groups[g].high;
        if (size >= low && size <= high) {
            found = g;
        }
    }
    return found;
}

}  // namespace gearpod::analysis
