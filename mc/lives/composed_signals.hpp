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
    // turns of transmission error of the same length, empty for none. The samples must outlive
    // it if turns are added. Without `folds` sums have no folded squares.
    ComposedSignals(std::span<const LaneSignals* const> basis, std::size_t bins, bool folds);

    // The sum with these coefficients, one for each of the basis: folded squares and transmission
    // error; no samples.
    LaneSignals at(std::span<const double> coefficients) const;

    // Adds its folded squares over some turns alone, from the samples; from the last turn it goes
    // on with the first.
    void add_turns(std::span<const double> coefficients, std::size_t first, std::size_t turns,
                   std::vector<double>& folded) const;

  private:
    std::vector<std::span<const double>> samples_;
    std::size_t bins_;
    std::size_t count_;
    std::vector<std::vector<double>> products_;  // folded, of k <= l, in rows
    std::vector<std::vector<double>> te_turns_;
};

}  // namespace gearpod::mc
