#include "analysis/monitoring/crack_effect.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

namespace gearpod::analysis {
namespace {

// Order statistic; `values` is not empty and is reordered.
double quantile_of(std::vector<double>& values, double share) {
    const auto place = values.begin() +
                       static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

std::vector<std::pair<double, double>> sizes_and_values(std::span<const CrackedLife> cracked) {
    std::vector<std::pair<double, double>> all;
    for (const CrackedLife& life : cracked) {
        for (std::size_t r = life.first; r < life.values.size(); ++r) {
            if (!std::isnan(life.values[r])) {
                all.emplace_back(life.sizes[r], life.values[r]);
            }
        }
    }
    std::ranges::stable_sort(all, {}, &std::pair<double, double>::first);
    return all;
}

}  // namespace

double effect_size(std::span<const HealthyLife> healthy, std::span<const CrackedLife> cracked,
                   bool two_sided) {
    constexpr std::size_t kMostGroups = 20, kLeastRecords = 40;
    std::vector<double> normal;
    for (const HealthyLife& life : healthy) {
        std::ranges::copy_if(life.values, std::back_inserter(normal),
                             [](double value) { return !std::isnan(value); });
    }
    if (normal.empty()) {
        return kNan;
    }
    const double deviation = 0.5 * (quantile_of(normal, 0.84) - quantile_of(normal, 0.16)),
                 median = quantile_of(normal, 0.5), high = quantile_of(normal, 0.9),
                 low = quantile_of(normal, 0.1);
    const auto records = sizes_and_values(cracked);
    const std::size_t groups =
        std::clamp<std::size_t>(records.size() / kLeastRecords, 1, kMostGroups);
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t g = groups; g-- > 0 && !records.empty();) {
        const std::size_t begin = g * records.size() / groups,
                          end = (g + 1) * records.size() / groups;
        std::vector<double> values;
        for (std::size_t i = begin; i < end; ++i) {
            values.push_back(records[i].second);
        }
        const double shift = quantile_of(values, 0.5) - median;
        double moved = std::max(shift, quantile_of(values, 0.9) - high);
        if (two_sided) {
            moved = std::max({moved, -shift, low - quantile_of(values, 0.1)});
        }
        if (!(moved > 0.0 && moved >= kEffectDeviations * deviation)) {
            break;
        }
        smallest = records[begin].first;
    }
    return smallest;
}

}  // namespace gearpod::analysis
