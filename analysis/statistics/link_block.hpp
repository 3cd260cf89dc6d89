// link_values() of many etas at once. Eigen's exponential and logarithm have the same bits on every
// processor.
#pragma once

#include <Eigen/Core>

#include "analysis/statistics/link.hpp"

namespace gearpod::analysis {

inline constexpr Eigen::Index kBlock = 128;  // arrays of a block stay on the stack
using Block = Eigen::Array<double, Eigen::Dynamic, 1, Eigen::ColMajor, kBlock, 1>;

struct LinkBlock {
    Block up, down, density;  // as in LinkValues

    LinkBlock(Link link, const Block& eta);
};

// Natural logarithms, of what is below the least normal number as of that number.
Block block_log(const Block& values);

}  // namespace gearpod::analysis
