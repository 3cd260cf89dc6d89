// Fewer points of a long curve, for drawing it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gearpod::mc {

// Ascending indices: all of them, or the smallest and the largest value of each of most / 2 equal
// stretches, so that no peak is lost. `most` at least 2.
std::vector<std::size_t> extremes(std::span<const double> values, std::size_t most);

// Ascending indices: all of them, or the largest value of each of `most` equal stretches.
std::vector<std::size_t> maxima(std::span<const double> values, std::size_t most);

}  // namespace gearpod::mc
