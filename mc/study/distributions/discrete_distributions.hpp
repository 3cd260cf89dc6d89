// Discrete distributions: a constant, values taken in turn, and random values of a list.
#pragma once

#include <algorithm>
#include <boost/random/uniform_01.hpp>
#include <cstdint>
#include <numeric>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "mc/study/distributions/field.hpp"
#include "mc/study/distributions/range.hpp"
#include "mc/study/random/philox.hpp"

namespace gearpod::mc {

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
