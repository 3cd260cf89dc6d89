#include "analysis/statistics/interval.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "analysis/statistics/distributions.hpp"
#include "analysis/statistics/link.hpp"

namespace gearpod::analysis {

Interval wilson_interval(long detected, long tested, double confidence) {
    if (detected < 0 || detected > tested || !(confidence > 0.0 && confidence < 1.0)) {
        throw std::invalid_argument(
            "Wilson interval: needs 0 <= detected <= tested and a confidence");
    }
    if (tested == 0) {
        return {kNan, kNan};
    }
    const double z = normal_upper_quantile(0.5 * (1.0 - confidence));
    const auto n = static_cast<double>(tested);
    const double p = static_cast<double>(detected) / n;
    const double z2 = z * z;
    const double centre = (p + z2 / (2.0 * n)) / (1.0 + z2 / n);
    const double half = z / (1.0 + z2 / n) * std::sqrt(p * (1.0 - p) / n + z2 / (4.0 * n * n));
    // Exactly 0 and 1 at the ends, where rounding would leave a residue.
    return {detected == 0 ? 0.0 : centre - half, detected == tested ? 1.0 : centre + half};
}

Interval clopper_pearson_interval(long detected, long tested, double confidence) {
    if (detected < 0 || detected > tested || !(confidence > 0.0 && confidence < 1.0)) {
        throw std::invalid_argument(
            "Clopper-Pearson interval: needs 0 <= detected <= tested and a confidence");
    }
    if (tested == 0) {
        return {kNan, kNan};
    }
    const double tail = 0.5 * (1.0 - confidence);
    const auto k = static_cast<double>(detected);
    const auto n = static_cast<double>(tested);
    Interval bounds{0.0, 1.0};
    if (detected > 0) {
        bounds.lower = beta_quantile(k, n - k + 1.0, tail);
    }
    if (detected < tested) {
        bounds.upper = beta_upper_quantile(k + 1.0, n - k, tail);
    }
    return bounds;
}

Interval difference_interval(double a, const Interval& of_a, double b, const Interval& of_b,
                             double correlation) {
    const auto reach = [&](double first, double second) {
        return std::sqrt(
            std::max(0.0, first * first - 2.0 * correlation * first * second + second * second));
    };
    const double difference = b - a;
    return {difference - reach(b - of_b.lower, of_a.upper - a),
            difference + reach(of_b.upper - b, a - of_a.lower)};
}

double outcome_correlation(const PairedCounts& counts) {
    const auto both = static_cast<double>(counts.both),
               neither = static_cast<double>(counts.neither);
    const auto only_a = static_cast<double>(counts.only_a);
    const auto only_b = static_cast<double>(counts.only_b);
    const double margins =
        (both + only_a) * (only_b + neither) * (both + only_b) * (only_a + neither);
    if (margins == 0.0) {
        return 0.0;
    }
    double product = both * neither - only_a * only_b;
    if (product > 0.0) {
        product = std::max(0.0, product - 0.5 * static_cast<double>(counts.pairs()));
    }
    return product / std::sqrt(margins);
}

double mcnemar_p_value(const PairedCounts& counts) {
    const long differ = counts.only_a + counts.only_b;
    if (differ == 0) {
        return 1.0;
    }
    const auto fewer = static_cast<double>(std::min(counts.only_a, counts.only_b));
    return std::min(1.0, 2.0 * binomial_cdf(static_cast<double>(differ), 0.5, fewer));
}

double pooled_p_value(long found_a, long tested_a, long found_b, long tested_b) {
    const auto a = static_cast<double>(tested_a), b = static_cast<double>(tested_b);
    const double rate = static_cast<double>(found_a + found_b) / (a + b);
    const double variance = rate * (1.0 - rate) * (1.0 / a + 1.0 / b);
    const double difference = static_cast<double>(found_b) / b - static_cast<double>(found_a) / a;
    return variance > 0.0
               ? 2.0 * link_probability(Link::probit, -std::abs(difference) / std::sqrt(variance))
               : 1.0;
}

std::vector<double> holm_adjusted(const std::vector<double>& p_values) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < p_values.size(); ++i) {
        if (!std::isnan(p_values[i])) {
            order.push_back(i);
        }
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return p_values[a] < p_values[b]; });
    std::vector<double> adjusted = p_values;
    double largest = 0.0;
    for (std::size_t rank = 0; rank < order.size(); ++rank) {
        const auto left = static_cast<double>(order.size() - rank);
        largest = std::max(largest, std::min(1.0, left * p_values[order[rank]]));
        adjusted[order[rank]] = largest;
    }
    return adjusted;
}

}  // namespace gearpod::analysis
