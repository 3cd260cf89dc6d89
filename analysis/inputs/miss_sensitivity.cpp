#include "analysis/inputs/miss_sensitivity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/statistics/difference_tests.hpp"
#include "analysis/statistics/link.hpp"
#include "analysis/statistics/rank_statistics.hpp"
#include "machine/no_value.hpp"

namespace gearpod::analysis {
namespace {

constexpr std::size_t kNeighbours = 100;
constexpr long kFewestOutcomes = 10;  // fewest misses, and hits, for the large-sample approximation

struct Stratum {
    std::vector<std::size_t> hits, misses;  // gearboxes
};

// Faulty gearboxes with a value, in strata of equal size or else of neighbouring sizes.
std::vector<Stratum> strata_of(std::span<const double> sizes, std::span<const int> hit) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        if (sizes[i] > 0.0 && hit[i] >= 0) {
            order.push_back(i);
        }
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return sizes[a] < sizes[b]; });
    std::vector<Stratum> strata;
    for (std::size_t first = 0; first < order.size();) {
        const auto equal = [&](std::size_t i) { return sizes[order[i]] == sizes[order[first]]; };
        std::size_t last = first;
        while (last < order.size() && (equal(last) || last - first < kNeighbours)) {
            if (!equal(last) && last > first + 1 && equal(first + 1)) {
                break;  // a repeated size is a stratum of its own
            }
            ++last;
        }
        Stratum stratum;
        for (std::size_t i = first; i < last; ++i) {
            (hit[order[i]] == 1 ? stratum.hits : stratum.misses).push_back(order[i]);
        }
        if (stratum.hits.size() >= 2 && stratum.misses.size() >= 2 &&
            stratum.hits.size() >= stratum.misses.size()) {
            strata.push_back(std::move(stratum));
        }
        first = last;
    }
    return strata;
}

std::vector<double> values_at(const InputColumn& input, const std::vector<std::size_t>& rows) {
    std::vector<double> values;
    for (const std::size_t row : rows) {
        values.push_back(input.values[row]);
    }
    return values;
}

bool varies(const InputColumn& input, const std::vector<Stratum>& strata) {
    const double first = input.values[strata.front().hits.front()];
    const auto differs = [&](std::size_t row) { return input.values[row] != first; };
    return std::any_of(strata.begin(), strata.end(), [&](const Stratum& stratum) {
        return std::any_of(stratum.hits.begin(), stratum.hits.end(), differs) ||
               std::any_of(stratum.misses.begin(), stratum.misses.end(), differs);
    });
}

InputInfluence influence(const InputColumn& input, const std::vector<Stratum>& strata,
                         double confidence) {
    double weights = 0.0, area = 0.0, variance = 0.0;
    long pairs = 0;
    for (const Stratum& stratum : strata) {
        const AucComponents components =
            auc_components(values_at(input, stratum.hits), values_at(input, stratum.misses));
        const auto m = static_cast<double>(stratum.hits.size());
        const auto n = static_cast<double>(stratum.misses.size());
        const double weight = m * n / (m + n + 1.0);
        weights += weight;
        area += weight * components.auc;
        variance += weight * weight * auc_covariance(components, components);
        pairs += static_cast<long>(std::min(stratum.hits.size(), stratum.misses.size()));
    }
    area /= weights;
    variance /= weights * weights;
    InputInfluence result{input.name, input.unit, area,
                          auc_interval(area, variance, pairs, confidence), 0.0};
    const double distance = std::abs(area - 0.5);
    result.p_value = variance > 0.0
                         ? 2.0 * link_probability(Link::probit, -distance / std::sqrt(variance))
                         : kNan;
    return result;
}

}  // namespace

MissSensitivity miss_sensitivity(std::span<const double> sizes, std::span<const int> hit,
                                 const std::vector<InputColumn>& inputs, double confidence) {
    MissSensitivity result;
    const std::vector<Stratum> strata = strata_of(sizes, hit);
    if (strata.empty()) {
        result.refusal = "no fault size at which most, but not all gearboxes are detected";
        return result;
    }
    result.smallest = std::numeric_limits<double>::infinity();
    for (const Stratum& stratum : strata) {
        result.hits += static_cast<long>(stratum.hits.size());
        result.misses += static_cast<long>(stratum.misses.size());
        for (const auto* rows : {&stratum.hits, &stratum.misses}) {
            for (const std::size_t row : *rows) {
                result.smallest = std::min(result.smallest, sizes[row]);
                result.largest = std::max(result.largest, sizes[row]);
            }
        }
    }
    if (std::min(result.misses, result.hits) < kFewestOutcomes) {
        result.refusal = fmt::format("{} misses and {} hits, {} of each are needed", result.misses,
                                     result.hits, kFewestOutcomes);
        return result;
    }
    std::vector<double> p_values;
    for (const InputColumn& input : inputs) {
        if (!varies(input, strata)) {
            result.left_out.push_back(input.name);
            continue;
        }
        result.inputs.push_back(influence(input, strata, confidence));
        p_values.push_back(result.inputs.back().p_value);
    }
    p_values = holm_adjusted(p_values);
    for (std::size_t i = 0; i < result.inputs.size(); ++i) {
        result.inputs[i].p_value = p_values[i];
    }
    std::stable_sort(result.inputs.begin(), result.inputs.end(),
                     [](const InputInfluence& a, const InputInfluence& b) {
                         return std::abs(a.larger_in_misses - 0.5) >
                                std::abs(b.larger_in_misses - 0.5);
                     });
    return result;
}

}  // namespace gearpod::analysis
