#include "analysis/statistics/rank_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "analysis/statistics/link.hpp"
#include "machine/contracts.hpp"

namespace gearpod::analysis {

std::vector<double> midranks(std::span<const double> values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
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

namespace {

double covariance(const std::vector<double>& a, double mean_a, const std::vector<double>& b,
                  double mean_b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        sum += (a[i] - mean_a) * (b[i] - mean_b);
    }
    return sum / static_cast<double>(a.size() - 1);
}

}  // namespace

AucComponents auc_components(std::span<const double> healthy, std::span<const double> faulty) {
    const auto is_finite = [](double value) { return std::isfinite(value); };
    EXPECTS(!healthy.empty() && std::ranges::all_of(healthy, is_finite));
    EXPECTS(!faulty.empty() && std::ranges::all_of(faulty, is_finite));
    std::vector<double> all(healthy.begin(), healthy.end());
    all.insert(all.end(), faulty.begin(), faulty.end());
    const std::vector<double> joint = midranks(all);
    const std::vector<double> in_healthy = midranks(healthy);
    const std::vector<double> in_faulty = midranks(faulty);
    const auto m = static_cast<double>(healthy.size());
    const auto n = static_cast<double>(faulty.size());
    AucComponents components;
    for (std::size_t i = 0; i < healthy.size(); ++i) {
        components.healthy.push_back(1.0 - (joint[i] - in_healthy[i]) / n);
    }
    for (std::size_t j = 0; j < faulty.size(); ++j) {
        components.faulty.push_back((joint[healthy.size() + j] - in_faulty[j]) / m);
        components.auc += joint[healthy.size() + j] - in_faulty[j];  // multiples of one half: exact
    }
    components.auc /= m * n;
    return components;
}

double auc_covariance(const AucComponents& a, const AucComponents& b) {
    if (a.healthy.size() != b.healthy.size() || a.faulty.size() != b.faulty.size()) {
        throw std::invalid_argument("AUC covariance: the areas must be of the same gearboxes");
    }
    return covariance(a.healthy, a.auc, b.healthy, b.auc) / static_cast<double>(a.healthy.size()) +
           covariance(a.faulty, a.auc, b.faulty, b.auc) / static_cast<double>(a.faulty.size());
}

Interval auc_interval(double auc, double variance, long pairs, double confidence) {
    // Rounding of the sum must not make a complete separation look incomplete.
    constexpr double kComplete = 1e-13;
    if (auc > 1.0 - kComplete) {
        return clopper_pearson_interval(pairs, pairs, confidence);
    }
    if (auc < kComplete) {
        return clopper_pearson_interval(0, pairs, confidence);
    }
    if (!(variance > 0.0)) {
        return {kNan, kNan};
    }
    const double z = link_quantile(Link::probit, 0.5 * (1.0 + confidence));
    const double half = z * std::sqrt(variance) / (auc * (1.0 - auc));
    const double centre = link_quantile(Link::logit, auc);
    return {link_probability(Link::logit, centre - half),
            link_probability(Link::logit, centre + half)};
}

Auc auc(std::span<const double> healthy, std::span<const double> faulty, bool high,
        double confidence) {
    const auto usable = [high](std::span<const double> values) {
        std::vector<double> out;
        for (const double value : values) {
            if (std::isfinite(value)) {
                out.push_back(high ? value : -value);
            }
        }
        return out;
    };
    const std::vector<double> low_side = usable(healthy), high_side = usable(faulty);
    Auc result{kNan,
               {kNan, kNan},
               static_cast<long>(low_side.size()),
               static_cast<long>(high_side.size())};
    if (low_side.empty() || high_side.empty()) {
        return result;
    }
    const AucComponents components = auc_components(low_side, high_side);
    result.auc = components.auc;
    const long pairs = std::min(result.healthy, result.faulty);
    if (pairs >= 2) {
        result.bounds =
            auc_interval(components.auc, auc_covariance(components, components), pairs, confidence);
    }
    return result;
}

}  // namespace gearpod::analysis
