// Discrete distribution: a random value of a list, with probabilities proportional to the weights.
// In contrast, `levels` takes its values in turn.
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

#include "mc/random/philox.hpp"
#include "mc/study/distributions/field.hpp"
#include "mc/study/distributions/support.hpp"

namespace gearpod::mc {

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

}  // namespace gearpod::mc
