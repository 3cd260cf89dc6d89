// Superposition of records from signals at several crack depths and loads.
#pragma once

#include <span>
#include <vector>

#include "mc/ensemble/gearbox/gearbox_tile.hpp"
#include "mc/plan/life_plan.hpp"
#include "mc/plan/record_plan.hpp"

namespace gearpod::mc {

// Torques or speeds at which a gearbox is integrated, as factors on its value, and the
// interpolation of signals between them.

// Weights of linear interpolation between the ascending integrated factors; the outer two also
// extrapolate.
std::vector<double> interpolation_weights(const std::vector<double>& integrated, double factor);

// Smallest and largest number of nodes of a polynomial.
inline constexpr int kLeastNodes = 3, kMostNodes = 17;

// The first nodes of a symmetric Leja sequence on [-1, 1]: 0, 1, -1, and then pairs, each where the
// product of the distances to all earlier nodes is largest (F. Leja, Ann. Polon. Math. 4 (1957),
// 8-13). Polynomials through them converge like those through Chebyshev points, but a longer
// sequence contains all nodes of a shorter one.
std::vector<double> leja_nodes(int count);

class LoadAxis {
  public:
    // Without nodes: evenly spaced quantiles from -1.5 to 1.5 standard deviations, with linear
    // interpolation and extrapolation. With nodes: one polynomial through so many factors from
    // -2.5 to 2.5 standard deviations (or the distribution's limits), continued linearly. A
    // quantity that does not vary has the factor 1, and one with distinct factors has all of these.
    LoadAxis(const RecordDistribution& distribution, const LoadNumber& number);

    const std::vector<double>& factors() const { return factors_; }  // ascending
    // Weight of the signal at each of them in that at another factor; the sum is 1.
    std::vector<double> weights(double factor) const;
    // One factor between each two neighbours; one of the factors if no others occur.
    const std::vector<double>& between() const { return between_; }
    // Factors where the error is largest, for choosing the number of nodes: between the neighbours
    // and beyond them, or the next two nodes.
    const std::vector<double>& checks() const { return checks_; }
    // False if the quantity does not vary or has distinct factors.
    bool interpolates() const { return !checks_.empty(); }

  private:
    std::vector<double> derivative_weights(std::size_t node) const;

    std::vector<double> factors_, between_, checks_;
    std::vector<double> barycentric_;  // weights of the polynomial; empty: piecewise linear
};

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
