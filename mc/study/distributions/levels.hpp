// Given values taken in turn: level index t gives values[t mod count]. A repeated value has a
// higher weight.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <vector>

#include "mc/random/philox.hpp"
#include "mc/study/distributions/field.hpp"
#include "mc/study/distributions/support.hpp"

namespace gearpod::mc {

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

}  // namespace gearpod::mc
