#include "analysis/size_groups.hpp"

#include <cmath>

namespace gearpod::analysis {

std::optional<std::size_t> group_of(double size_m, const std::vector<SizeGroup>& groups) {
    constexpr double kSameSize = 1e-9;
    std::optional<std::size_t> found;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const double slack = kSameSize * std::abs(groups[g].high_m);
        const bool level = groups[g].low_m == groups[g].high_m;
        const double low = level ? groups[g].low_m - slack : groups[g].low_m;
        const double high = level ? groups[g].high_m + slack : groups[g].high_m;
        if (size_m >= low && size_m <= high) {
            found = g;
        }
    }
    return found;
}

}  // namespace gearpod::analysis
