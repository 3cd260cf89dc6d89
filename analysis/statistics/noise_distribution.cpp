#include "analysis/statistics/noise_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "analysis/statistics/link.hpp"
#include "analysis/statistics/numeric_maximum.hpp"

namespace gearpod::analysis {
namespace {

using Kind = NoiseDistribution::Kind;

double mean_of(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// Normal distribution of the values, or of their logarithms with the Jacobian of the logarithm.
NoiseDistribution normal_law(std::span<const double> values, Kind kind, double jacobian) {
    const double mean = mean_of(values);
    double squares = 0.0;
    for (const double value : values) {
        squares += (value - mean) * (value - mean);
    }
    const auto n = static_cast<double>(values.size());
    const double variance = squares / n;
    const double log_likelihood =
        -0.5 * n * (std::log(2.0 * std::numbers::pi * variance) + 1.0) - jacobian;
    return {kind, mean, std::sqrt(variance), 4.0 - 2.0 * log_likelihood};
}

NoiseDistribution exponential_law(std::span<const double> values) {
    const double mean = mean_of(values);
    const double log_likelihood = -static_cast<double>(values.size()) * (std::log(mean) + 1.0);
    return {Kind::exponential, mean, 1.0, 2.0 - 2.0 * log_likelihood};
}

NoiseDistribution weibull_law(std::span<const double> values) {
    const double mean = mean_of(values);
    const auto log_likelihood = [&](const Eigen::VectorXd& p) {
        const double scale = mean * std::exp(p[0]), shape = std::exp(p[1]);
        double sum = 0.0;
        for (const double value : values) {
            const double log_ratio = std::log(value / scale);
            sum +=
                std::log(shape / scale) + (shape - 1.0) * log_ratio - std::exp(shape * log_ratio);
        }
        return sum;
    };
    const NumericMaximum found = numeric_maximum(log_likelihood, Eigen::Vector2d(0.0, 0.0));
    return {Kind::weibull, mean * std::exp(found.at[0]), std::exp(found.at[1]),
            4.0 - 2.0 * found.value};
}

}  // namespace

double NoiseDistribution::above(double value) const {
    switch (kind) {
        case Kind::normal:
            return link_probability(Link::probit, (first - value) / second);
        case Kind::lognormal:
            return value > 0.0 ? link_probability(Link::probit, (first - std::log(value)) / second)
                               : 1.0;
        case Kind::exponential:
        case Kind::weibull:
            break;
    }
    return value > 0.0 ? std::exp(-std::pow(value / first, second)) : 1.0;
}

double NoiseDistribution::below(double value) const {
    switch (kind) {
        case Kind::normal:
            return link_probability(Link::probit, (value - first) / second);
        case Kind::lognormal:
            return value > 0.0 ? link_probability(Link::probit, (std::log(value) - first) / second)
                               : 0.0;
        case Kind::exponential:
        case Kind::weibull:
            break;
    }
    return value > 0.0 ? -std::expm1(-std::pow(value / first, second)) : 0.0;
}

double NoiseDistribution::exceeded_by(double share) const {
    const double z = link_upper_quantile(Link::probit, share);
    switch (kind) {
        case Kind::normal:
            return first + second * z;
        case Kind::lognormal:
            return std::exp(first + second * z);
        case Kind::exponential:
        case Kind::weibull:
            break;
    }
    return first * std::pow(-std::log(share), 1.0 / second);
}

const char* noise_distribution_name(Kind kind) {
    switch (kind) {
        case Kind::normal:
            return "normal";
        case Kind::lognormal:
            return "lognormal";
        case Kind::exponential:
            return "exponential";
        case Kind::weibull:
            break;
    }
    return "Weibull";
}

std::vector<NoiseDistribution> fit_noise_distributions(std::span<const double> values) {
    if (values.size() < 3 ||
        !(*std::ranges::max_element(values) > *std::ranges::min_element(values))) {
        return {};
    }
    std::vector<NoiseDistribution> laws{normal_law(values, Kind::normal, 0.0)};
    if (*std::ranges::min_element(values) > 0.0) {
        std::vector<double> logs;
        double jacobian = 0.0;
        for (const double value : values) {
            logs.push_back(std::log(value));
            jacobian += logs.back();
        }
        laws.push_back(normal_law(logs, Kind::lognormal, jacobian));
        laws.push_back(exponential_law(values));
        laws.push_back(weibull_law(values));
    }
    std::ranges::stable_sort(
        laws, [](const NoiseDistribution& a, const NoiseDistribution& b) { return a.aic < b.aic; });
    return laws;
}

}  // namespace gearpod::analysis
