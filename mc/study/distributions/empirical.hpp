// Empirical distribution: a list of equally probable values, measured or sampled from a posterior.
// Inputs with the same nonzero `rows` use the same index into their lists, so that values measured
// together stay together.
#pragma once

#include <algorithm>
#include <boost/random/uniform_01.hpp>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <vector>

#include "mc/random/philox.hpp"
#include "mc/study/distributions/field.hpp"
#include "mc/study/distributions/support.hpp"

namespace gearpod::mc {

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
        const double place = boost::random::uniform_01<double>()(engine);
        return values[static_cast<std::size_t>(place * static_cast<double>(values.size()))];
    }
    double quantile(double p) const {
        std::vector<double> ascending = values;
        const auto place = static_cast<std::size_t>(p * static_cast<double>(values.size()));
        const auto at =
            ascending.begin() + static_cast<std::ptrdiff_t>(std::min(place, values.size() - 1));
        std::nth_element(ascending.begin(), at, ascending.end());
        return *at;
    }
    bool operator==(const Empirical&) const = default;
};

}  // namespace gearpod::mc
