// Vectorised link_values(). Eigen's exponential and logarithm give the same bits on every
// processor.
#pragma once

#include <Eigen/Core>

#include "analysis/statistics/link.hpp"

namespace gearpod::analysis {

// Small enough that the arrays of a block stay on the stack.
inline constexpr Eigen::Index kBlock = 128;
using Block = Eigen::Array<double, Eigen::Dynamic, 1, Eigen::ColMajor, kBlock, 1>;

struct LinkBlock {
    Block up, down, density;  // as in LinkValues

    LinkBlock(Link link, const Block& eta);
};

// Natural logarithms. Values below the smallest normal number are replaced by that number.
Block block_log(const Block& values);

}  // namespace gearpod::analysis
