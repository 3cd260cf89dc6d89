// Torques or speeds at which a gearbox is integrated, as factors on its value, and the
// interpolation of signals between them.
#pragma once

#include <vector>

#include "mc/plan/life_plan.hpp"

namespace gearpod::mc {

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

}  // namespace gearpod::mc
