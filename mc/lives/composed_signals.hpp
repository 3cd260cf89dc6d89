// Signals that are sums of a few: what a record sees of a gearbox is a sum of its signals at some
// depths of the crack and torques, and of the noise of an earlier record. Their folded squares
// follow from the folded products, without a look at the samples.
#pragma once

#include <span>
#include <vector>

#include "mc/gearbox/gearbox_tile.hpp"

namespace gearpod::mc {

class ComposedSignals {
  public:
    // `basis`: sensors of the same length, of which the whole turns of `bins` samples fold, and
    // turns of transmission error of the same length, empty for none. What is marched is looked at
    // here alone.
    ComposedSignals(std::span<const LaneSignals* const> basis, std::size_t bins);

    // The sum with these coefficients, one for each of the basis: folded squares and transmission
    // error; no samples.
    LaneSignals at(std::span<const double> coefficients) const;

  private:
    std::size_t count_;
    std::vector<std::vector<double>> products_;  // folded, of k <= l, in rows
    std::vector<std::vector<double>> te_turns_;
};

}  // namespace gearpod::mc
