#include "analysis/inputs/correlation_ratio.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "analysis/inputs/input_bins.hpp"
#include "analysis/statistics/interval.hpp"
#include "analysis/statistics/noncentral_f.hpp"
#include "analysis/statistics/quiet_policy.hpp"

namespace gearpod::analysis {
namespace {

constexpr double kLeastUnit = std::numeric_limits<double>::min();

// Analysis of variance of y in bins of x; y has mean 0.
struct Variances {
    double count = 0.0, bins = 0.0;
    double between = 0.0, within = 0.0;  // sums of squares
    std::vector<double> fitted;          // bin mean of each value

    double total() const { return between + within; }
    double noise() const { return within / (count - bins); }
    double f() const { return between / (bins - 1.0) / noise(); }
    double share() const { return (between - (bins - 1.0) * noise()) / total(); }
};

Variances variances_of(std::span<const double> x, std::span<const double> y, std::size_t most) {
    const InputBins bins = equal_count_bins(x, most);
    std::vector<double> sum(bins.bins, 0.0), count(bins.bins, 0.0);
    for (std::size_t i = 0; i < y.size(); ++i) {
        sum[bins.of[i]] += y[i];
        count[bins.of[i]] += 1.0;
    }
    Variances v;
    v.count = static_cast<double>(y.size());
    v.bins = static_cast<double>(bins.bins);
    v.fitted.resize(y.size());
    for (std::size_t i = 0; i < y.size(); ++i) {
        const std::size_t b = bins.of[i];
        v.fitted[i] = sum[b] / count[b];
        v.between += v.fitted[i] * v.fitted[i];
        v.within += (y[i] - v.fitted[i]) * (y[i] - v.fitted[i]);
    }
    return v;
}

// Share of variance whose noncentrality gives the observed F or less with this probability.
double share_at(const Variances& v, double probability) {
    const auto beyond = [&](double share) {
        const double noncentrality = v.count * share / (1.0 - share);
        return noncentral_f_cdf(v.f(), v.bins - 1.0, v.count - v.bins, noncentrality) - probability;
    };
    constexpr double kLeast = 1e-9;
    if (!(beyond(kLeast) > 0.0)) {
        return 0.0;
    }
    const double most = 1.0 - 1e-6;
    if (beyond(most) > 0.0) {
        return 1.0;
    }
    std::uintmax_t steps = 60;
    const auto bracket = boost::math::tools::toms748_solve(
        beyond, kLeast, most, boost::math::tools::eps_tolerance<double>(20), steps, QuietPolicy());
    return 0.5 * (bracket.first + bracket.second);
}

// Standard deviation of the estimate from its influence function relative to that under a normal
// distribution, at least 1.
double widening(const Variances& v, std::span<const double> y) {
    const double n = v.count, variance = v.total() / n;
    const double raw = v.between / v.total();
    double square = 0.0;
    for (std::size_t i = 0; i < y.size(); ++i) {
        const double m = v.fitted[i];
        const double influence = (2.0 * m * y[i] - m * m - raw * y[i] * y[i]) / variance;
        square += influence * influence;
    }
    const double noise = std::pow(v.noise() / variance, 2);
    // Variance from bins without influence.
    const double chance = 2.0 * (v.bins - 1.0) * noise / (n * n);
    const double own = std::max(0.0, square / (n * n) - 2.0 * chance) + chance;
    const double share = std::max(0.0, v.share());
    return std::sqrt(std::max(1.0, own / (2.0 * noise * share * (2.0 - share) / n + chance)));
}

// Power of two near the largest value, by which division is exact, so that squares neither overflow
// nor underflow.
double power_of_two(std::span<const double> values) {
    double largest = 0.0;
    for (const double value : values) {
        largest = std::max(largest, std::abs(value));
    }
    return largest > 0.0 ? std::max(std::exp2(std::ilogb(largest)), kLeastUnit) : 1.0;
}

}  // namespace

CorrelationRatio correlation_ratio(std::span<const double> x, std::span<const double> y,
                                   double confidence) {
    constexpr std::size_t kFewest = 20;
    CorrelationRatio result{kNan, {kNan, kNan}};
    if (y.size() < kFewest) {
        return result;
    }
    const auto n = static_cast<double>(y.size());
    const double unit = power_of_two(y);
    double mean = 0.0;
    for (const double value : y) {
        mean += value / unit / n;
    }
    std::vector<double> centred;
    for (const double value : y) {
        centred.push_back(value / unit - mean);
    }
    const auto most = static_cast<std::size_t>(std::lround(2.0 * std::cbrt(n)));
    const Variances v = variances_of(x, centred, most);
    if (v.bins < 2.0 || !(v.total() > 1e-24 * mean * mean * n)) {
        return result;
    }
    constexpr double kRounding = 1e-24;
    if (!(v.within > kRounding * v.total())) {
        return {1.0, {kNan, 1.0}};  // no scatter within bins, so no lower bound
    }
    result.share = v.share();
    const double wide = widening(v, centred);
    const double tail = 0.5 * (1.0 - confidence);
    const double low = share_at(v, 1.0 - tail), high = share_at(v, tail);
    result.bounds.lower =
        low > 0.0 ? std::clamp(result.share - wide * (result.share - low), 0.0, 1.0) : 0.0;
    result.bounds.upper = std::clamp(result.share + wide * (high - result.share), 0.0, 1.0);
    return result;
}

}  // namespace gearpod::analysis
