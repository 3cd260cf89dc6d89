// Thinning of long curves for plots.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gearpod::mc {

// Returns ascending indices: all of them, or the smallest and the largest value of each of most / 2
// equal intervals, so that no peak is lost. `most` must be at least 2.
std::vector<std::size_t> extremes(std::span<const double> values, std::size_t most);

// Returns ascending indices: all of them, or the largest value of each of `most` equal intervals.
std::vector<std::size_t> maxima(std::span<const double> values, std::size_t most);

}  // namespace gearpod::mc
