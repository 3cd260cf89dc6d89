// Columns of a table that is stored row by row.
#pragma once

#include <span>
#include <vector>

namespace gearpod::analysis {

// Value number `first` and every `step`-th one after it.
inline std::vector<double> every_nth(std::span<const double> values, std::size_t first,
                                     std::size_t step) {
    std::vector<double> out;
    for (std::size_t i = first; i < values.size(); i += step) {
        out.push_back(values[i]);
    }
    return out;
}

}  // namespace gearpod::analysis
