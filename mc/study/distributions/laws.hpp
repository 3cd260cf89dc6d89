// Continuous and discrete distributions.
#pragma once

#include <algorithm>
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <boost/random/lognormal_distribution.hpp>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/triangle_distribution.hpp>
#include <boost/random/uniform_01.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "machine/contracts.hpp"
#include "mc/study/distributions/range.hpp"
#include "mc/study/random/philox.hpp"

namespace gearpod::mc {

// Uniform distribution on [low, high).
struct Uniform : LawDefaults {
    static constexpr std::string_view kName = "uniform";
    double low = 0.0;
    double high = 0.0;

    static constexpr auto fields() {
        return std::tuple{Field{"low", &Uniform::low}, Field{"high", &Uniform::high}};
    }
    std::string problem() const { return low >= high ? "low must be below high" : ""; }
    double median() const { return 0.5 * low + 0.5 * high; }
    Support support() const { return {low, high, false, false}; }
    double draw(Philox& engine, std::uint64_t) const {
        return boost::random::uniform_real_distribution<double>(low, high)(engine);
    }
    double quantile(double p) const { return low + p * (high - low); }
    bool operator==(const Uniform&) const = default;
};

// Triangular distribution: density highest at the mode, falling linearly to zero at low and high.
struct Triangular : LawDefaults {
    static constexpr std::string_view kName = "triangular";
    double low = 0.0;
    double mode = 0.0;
    double high = 0.0;

    static constexpr auto fields() {
        return std::tuple{Field{"low", &Triangular::low}, Field{"mode", &Triangular::mode},
                          Field{"high", &Triangular::high}};
    }
    std::string problem() const {
        return low >= high || low > mode || mode > high
                   ? "must have low <= mode <= high and low < high"
                   : "";
    }
    double median() const {
        const double width = high - low;
        return 2.0 * mode >= low + high ? low + std::sqrt(0.5 * width * (mode - low))
                                        : high - std::sqrt(0.5 * width * (high - mode));
    }
    Support support() const { return {low, high, false, false}; }
    double draw(Philox& engine, std::uint64_t) const {
        return boost::random::triangle_distribution<double>(low, mode, high)(engine);
    }
    double quantile(double p) const {
        const double width = high - low, left = (mode - low) / width;
        return p < left ? low + std::sqrt(p * width * (mode - low))
                        : high - std::sqrt((1.0 - p) * width * (high - mode));
    }
    bool operator==(const Triangular&) const = default;
};

// Normal distribution. Values beyond 8.3 standard deviations (probability 1e-16) are rejected and
// sampled again. A bounded input may therefore be normal if its bound is that far from the mean.
struct Normal : LawDefaults {
    static constexpr std::string_view kName = "normal";
    double mean = 0.0;
    double sd = 0.0;

    static constexpr auto fields() {
        return std::tuple{Field{"mean", &Normal::mean}, Field{"sd", &Normal::sd, kPositiveField}};
    }
    double median() const { return mean; }
    static constexpr double kReach = 8.3;  // standard deviations
    Support support() const { return {mean - kReach * sd, mean + kReach * sd}; }
    double draw(Philox& engine, std::uint64_t) const {
        boost::random::normal_distribution<double> normal;
        double z = normal(engine);
        while (std::abs(z) > kReach) {
            z = normal(engine);
        }
        return mean + sd * z;
    }
    double quantile(double p) const {
        return mean - sd * std::sqrt(2.0) * boost::math::erfc_inv(2.0 * p);
    }
    bool operator==(const Normal&) const = default;
};

// Truncated normal distribution: mean and sd before truncation to [low, high]. Sampled by inverting
// its distribution function. It is evaluated on the side of the mean where the tail is small, so
// that an interval far from the mean keeps its shape.
struct TruncatedNormal : LawDefaults {
    static constexpr std::string_view kName = "truncated-normal";
    double mean = 0.0;
    double sd = 0.0;
    double low = 0.0;
    double high = 0.0;

    static constexpr auto fields() {
        return std::tuple{Field{"mean", &TruncatedNormal::mean},
                          Field{"sd", &TruncatedNormal::sd, kPositiveField},
                          Field{"low", &TruncatedNormal::low},
                          Field{"high", &TruncatedNormal::high}};
    }
    std::string problem() const {
        if (low >= high) {
            return "low must be below high";
        }
        const double deviations = std::max((low - mean) / sd, (mean - high) / sd);
        return deviations > kFarthest ? "low..high lies more than 30 sd away from the mean" : "";
    }
    double median() const { return quantile(0.5); }
    Support support() const { return {low, high, false, false}; }
    double draw(Philox& engine, std::uint64_t) const {
        return quantile(boost::random::uniform_01<double>()(engine));
    }
    double quantile(double p) const {
        EXPECTS(p >= 0.0 && p < 1.0);
        const double side = mean < 0.5 * low + 0.5 * high ? 1.0 : -1.0;
        const double scale = side / (std::sqrt(2.0) * sd);
        const double tail_low = std::erfc((low - mean) * scale);
        const double tail_high = std::erfc((high - mean) * scale);
        const double tail = tail_low + p * (tail_high - tail_low);
        // Bound of an interval that reaches to where erfc underflows to 0 or rounds to 2.
        if (tail <= 0.0 || tail >= 2.0) {
            return (tail <= 0.0) == (side > 0.0) ? high : low;
        }
        const double deviation = boost::math::erfc_inv(tail) / scale;
        return std::clamp(mean + deviation, low, high);
    }
    bool operator==(const TruncatedNormal&) const = default;

  private:
    // Beyond 30 standard deviations the tail probabilities approach the smallest doubles.
    static constexpr double kFarthest = 30.0;
};

// Lognormal distribution, given by its median and its coefficient of variation cv = sd / mean:
// sigma^2 = ln(1 + cv^2), mu = ln(median). The member cannot be called
// `median` as in the study file, because median() is a function.
struct Lognormal : LawDefaults {
    static constexpr std::string_view kName = "lognormal";
    double middle = 0.0;
    double cv = 0.0;

    static constexpr auto fields() {
        return std::tuple{Field{"median", &Lognormal::middle, kPositiveField},
                          Field{"cv", &Lognormal::cv, kPositiveField}};
    }
    double median() const { return middle; }
    Support support() const { return {0.0, std::numeric_limits<double>::infinity(), true, true}; }
    double draw(Philox& engine, std::uint64_t) const {
        const double sigma = std::sqrt(std::log1p(cv * cv));
        return boost::random::lognormal_distribution<double>(std::log(middle), sigma)(engine);
    }
    double quantile(double p) const {
        const double z = -std::sqrt(2.0) * boost::math::erfc_inv(2.0 * p);
        return middle * std::exp(std::sqrt(std::log1p(cv * cv)) * z);
    }
    bool operator==(const Lognormal&) const = default;
};

// Weibull distribution, for lives, wind speeds and loads: P(value > x) = exp(-(x / scale)^shape).
struct Weibull : LawDefaults {
    static constexpr std::string_view kName = "weibull";
    double scale = 0.0;
    double shape = 0.0;

    // Range of the shape: below 0.2 values reach down to the smallest doubles, above 1e4 the
    // distribution is practically a constant.
    static constexpr auto fields() {
        return std::tuple{Field{"scale", &Weibull::scale, kPositiveField},
                          Field{"shape", &Weibull::shape, Range{0.2, 1e4}}};
    }
    double median() const { return quantile(0.5); }
    Support support() const { return {0.0, std::numeric_limits<double>::infinity(), true, true}; }
    double draw(Philox& engine, std::uint64_t) const {
        constexpr double kLeast = 0x1p-54;  // replaces 0, which occurs once in 2^53 times
        return quantile(std::max(kLeast, boost::random::uniform_01<double>()(engine)));
    }
    double quantile(double p) const { return scale * std::pow(-std::log1p(-p), 1.0 / shape); }
    bool operator==(const Weibull&) const = default;
};

// Beta distribution on [low, high]: density proportional to (x - low)^(alpha - 1) (high - x)^(beta
// - 1). Sampled by inverting its distribution function.
struct Beta : LawDefaults {
    static constexpr std::string_view kName = "beta";
    double low = 0.0;
    double high = 0.0;
    double alpha = 0.0;
    double beta = 0.0;

    static constexpr auto fields() {
        constexpr Range kExponent{0.05, 1e4};  // within it the inverse is exact to rounding
        return std::tuple{Field{"low", &Beta::low}, Field{"high", &Beta::high},
                          Field{"alpha", &Beta::alpha, kExponent},
                          Field{"beta", &Beta::beta, kExponent}};
    }
    std::string problem() const { return low >= high ? "low must be below high" : ""; }
    double median() const { return quantile(0.5); }
    Support support() const { return {low, high, false, false}; }
    double draw(Philox& engine, std::uint64_t) const {
        return quantile(boost::random::uniform_01<double>()(engine));
    }
    double quantile(double p) const {
        return low + (high - low) * boost::math::ibeta_inv(alpha, beta, p);
    }
    bool operator==(const Beta&) const = default;
};

// Discrete distributions: a constant, values taken in turn, and random values of a list.

// Degenerate distribution: one value for all gearboxes.
struct Constant : LawDefaults {
    static constexpr std::string_view kName = "constant";
    double value = 0.0;

    static constexpr auto fields() { return std::tuple{Field{"value", &Constant::value}}; }
    double median() const { return value; }
    Support support() const { return {value, value, false, false}; }
    std::vector<double> levels() const { return {value}; }
    double draw(Philox&, std::uint64_t) const { return value; }
    bool operator==(const Constant&) const = default;
};

// Given values taken in turn: level index t gives values[t mod count]. A repeated value has a
// higher weight.
struct Levels : LawDefaults {
    static constexpr std::string_view kName = "levels";
    std::vector<double> values;

    static constexpr auto fields() { return std::tuple{Field{"values", &Levels::values}}; }
    // Lower median: the smaller of the two middle values when the count is even, so that it is one
    // of the levels.
    double median() const {
        std::vector<double> sorted = values;
        std::sort(sorted.begin(), sorted.end());
        return sorted[(sorted.size() - 1) / 2];
    }
    Support support() const {
        const auto [low, high] = std::minmax_element(values.begin(), values.end());
        return {*low, *high, false, false};
    }
    std::vector<double> levels() const { return values; }
    double draw(Philox&, std::uint64_t level_index) const {
        return values[level_index % values.size()];
    }
    bool operator==(const Levels&) const = default;
};

// Equally spaced values from low to high, both included, taken in turn: level index t gives value
// number t mod count.
struct Grid {
    static constexpr std::string_view kName = "grid";
    double low = 0.0;
    double high = 0.0;
    int count = 0;

    static constexpr auto fields() {
        return std::tuple{Field{"low", &Grid::low}, Field{"high", &Grid::high},
                          Field{"count", &Grid::count, {2.0, 1e5, false, false}}};
    }
    std::string problem() const { return low >= high ? "low must be below high" : ""; }
    double median() const { return value((count - 1) / 2); }
    Support support() const { return {low, high, false, false}; }
    std::vector<double> levels() const {
        std::vector<double> values;
        for (int i = 0; i < count; ++i) {
            values.push_back(value(i));
        }
        return values;
    }
    double draw(Philox&, std::uint64_t level_index) const {
        return value(static_cast<int>(level_index % static_cast<std::uint64_t>(count)));
    }
    bool operator==(const Grid&) const = default;

  private:
    double value(int i) const {
        return i == count - 1 ? high : low + (high - low) * i / (count - 1);
    }
};

// Discrete distribution: a random value of a list, with probabilities proportional to the weights.
// In contrast, `levels` takes its values in turn.
struct Discrete : LawDefaults {
    static constexpr std::string_view kName = "discrete";
    std::vector<double> values;
    std::vector<double> weights;

    static constexpr auto fields() {
        return std::tuple{Field{"values", &Discrete::values},
                          Field{"weights", &Discrete::weights, kPositiveField}};
    }
    std::string problem() const {
        const bool both = !values.empty() && !weights.empty();  // else reported separately
        return both && values.size() != weights.size()
                   ? "values and weights must have the same length"
                   : "";
    }
    double median() const { return quantile(0.5); }
    Support support() const {
        const auto [low, high] = std::minmax_element(values.begin(), values.end());
        return {*low, *high, false, false};
    }
    double draw(Philox& engine, std::uint64_t) const {
        double left = boost::random::uniform_01<double>()(engine) * total();
        for (std::size_t i = 0; i + 1 < values.size(); ++i) {
            left -= weights[i];
            if (left < 0.0) {
                return values[i];
            }
        }
        return values.back();
    }
    double quantile(double p) const {
        std::vector<std::pair<double, double>> ascending;
        for (std::size_t i = 0; i < values.size(); ++i) {
            ascending.emplace_back(values[i], weights[i]);
        }
        std::sort(ascending.begin(), ascending.end());
        double left = p * total();
        for (const auto& [value, weight] : ascending) {
            left -= weight;
            if (left <= 0.0) {
                return value;
            }
        }
        return ascending.back().first;
    }
    bool operator==(const Discrete&) const = default;

  private:
    double total() const { return std::accumulate(weights.begin(), weights.end(), 0.0); }
};

// Empirical distribution: a list of equally probable values, measured or sampled from a posterior.
// Inputs with the same nonzero `rows` use the same index into their lists, so that values measured
// together stay together.
struct Empirical : LawDefaults {
    static constexpr std::string_view kName = "empirical";
    static constexpr std::string_view kOtherwise =
        "or, instead of values and rows: file (path of a CSV file) and column (its name); columns "
        "of the same file are sampled by row";
    std::vector<double> values;
    int rows = 0;

    static constexpr auto fields() {
        constexpr Range kGroup{0, 1e6};
        return std::tuple{Field{"values", &Empirical::values},
                          Field{"rows", &Empirical::rows, kGroup, true}};
    }
    double median() const { return quantile(0.5); }
    Support support() const {
        const auto [low, high] = std::minmax_element(values.begin(), values.end());
        return {*low, *high, false, false};
    }
    double draw(Philox& engine, std::uint64_t) const {
        const double share = boost::random::uniform_01<double>()(engine);
        return values[static_cast<std::size_t>(share * static_cast<double>(values.size()))];
    }
    double quantile(double p) const {
        std::vector<double> ascending = values;
        const auto rank = static_cast<std::size_t>(p * static_cast<double>(values.size()));
        const auto ranked =
            ascending.begin() + static_cast<std::ptrdiff_t>(std::min(rank, values.size() - 1));
        std::nth_element(ascending.begin(), ranked, ascending.end());
        return *ranked;
    }
    bool operator==(const Empirical&) const = default;
};

}  // namespace gearpod::mc
