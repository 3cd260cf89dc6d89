// Kolmogorov-Smirnov statistics, scaled by the square root of the (effective) sample size. They
// exceed 1.95 only once in a thousand samples from the right distribution.
#pragma once

#include "tests/test.hpp"

namespace gearpod::signals {

template <typename Cdf>
double kolmogorov(std::vector<double> sample, Cdf cdf) {
    std::sort(sample.begin(), sample.end());
    const auto n = static_cast<double>(sample.size());
    double largest = 0.0;
    for (std::size_t i = 0; i < sample.size(); ++i) {
        const double f = cdf(sample[i]);
        largest =
            std::max({largest, f - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - f});
    }
    return largest * std::sqrt(n);
}

inline double kolmogorov_two(std::vector<double> a, std::vector<double> b) {
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    const auto n = static_cast<double>(a.size());
    const auto m = static_cast<double>(b.size());
    double largest = 0.0;
    std::size_t j = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        while (j < b.size() && b[j] <= a[i]) {
            ++j;
        }
        largest = std::max(largest,
                           std::abs(static_cast<double>(i + 1) / n - static_cast<double>(j) / m));
    }
    return largest * std::sqrt(n * m / (n + m));
}

}  // namespace gearpod::signals
