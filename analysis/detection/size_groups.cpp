#include "analysis/detection/size_groups.hpp"

#include <cmath>

#include "analysis/detection/threshold.hpp"
#include "analysis/statistics/clopper_pearson.hpp"
#include "analysis/statistics/interval.hpp"
#include "analysis/statistics/wilson.hpp"

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

std::vector<std::size_t> groups_of(std::span<const double> sizes,
                                   const std::vector<SizeGroup>& groups) {
    std::vector<std::size_t> out;
    out.reserve(sizes.size());
    for (const double size : sizes) {
        out.push_back(group_of(size, groups).value_or(kNoGroup));
    }
    return out;
}

void count(DetectionCell& cell, double value, double threshold, Alarm alarm) {
    if (!std::isfinite(value)) {
        ++cell.failed;
        return;
    }
    ++cell.tested;
    cell.detected += is_alarm(value, threshold, alarm) ? 1 : 0;
}

// Without a threshold there is no rate, but the gearboxes are still counted.
void rate(DetectionCell& cell, bool has_threshold, double confidence) {
    if (!has_threshold || cell.tested == 0) {
        cell.pd = cell.lower = cell.upper = kNan;
        cell.exact = {kNan, kNan};
        return;
    }
    const Interval bounds = wilson_interval(cell.detected, cell.tested, confidence);
    cell.pd = static_cast<double>(cell.detected) / static_cast<double>(cell.tested);
    cell.lower = bounds.lower;
    cell.upper = bounds.upper;
    cell.exact = clopper_pearson_interval(cell.detected, cell.tested, confidence);
}

}  // namespace gearpod::analysis
