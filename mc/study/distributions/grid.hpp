// Equally spaced values from low to high, both included, taken in turn: level index t gives value
// number t mod count.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "mc/random/philox.hpp"
#include "mc/study/distributions/field.hpp"
#include "mc/study/distributions/support.hpp"

namespace gearpod::mc {

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

}  // namespace gearpod::mc
