// Superposition of records from signals at several crack depths and loads.
#pragma once

#include <span>
#include <vector>

#include "mc/ensemble/gearbox/gearbox_tile.hpp"
#include "mc/plan/record_plan.hpp"

namespace gearpod::mc {

// Needs of features in lives. Unlike in compared_needs(), a change is superposed without the
// samples of the record and of the baseline.
ComparedNeeds superposed_needs(std::span<const features::Feature* const> features);

// Superposition of signals. The signal of a record is a linear combination of the gearbox's signals
// at several crack depths and torques, and of the noise of earlier records. Its folded squares
// follow from folded products, without the samples.
class SuperposedSignals {
  public:
    // `basis`: sensor signals of equal length, which consist of whole turns of `bins` samples, and
    // averaged transmission errors of equal length, which may be empty. The samples must outlive
    // the object if add_turns() is used. Without `folds`, at() gives no folded squares.
    SuperposedSignals(std::span<const LaneSignals* const> basis, std::size_t bins, bool folds);

    // Linear combination with one coefficient per basis signal: folded squares and transmission
    // error, without samples.
    LaneSignals at(std::span<const double> coefficients) const;

    // Adds the folded squares of `turns` turns of a linear combination, computed from the samples.
    // The turns continue periodically after the last one.
    void add_turns(std::span<const double> coefficients, std::size_t first, std::size_t turns,
                   std::vector<double>& folded) const;

    // Appends the samples of such turns.
    void append_turns(std::span<const double> coefficients, std::size_t first, std::size_t turns,
                      std::vector<double>& samples) const;

  private:
    std::vector<double> turn(std::span<const double> coefficients, std::size_t number) const;

    std::vector<std::span<const double>> samples_;
    std::size_t bins_;
    std::size_t count_;
    std::vector<std::vector<double>> products_;  // folded products for k <= l, row by row
    std::vector<std::vector<double>> te_turns_;
};

}  // namespace gearpod::mc
