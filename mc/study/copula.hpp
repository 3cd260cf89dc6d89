// Gaussian copula: correlates random inputs and leaves the distribution of each one unchanged.
// Normal variates with correlation r have the rank correlation (6 / pi) asin(r / 2), whatever
// increasing functions are then applied to them: K. Pearson, Drapers' Company Research Memoirs IV
// (1907); W. H. Kruskal, J. Am. Stat. Assoc. 53 (1958), 814-861.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "mc/study/study.hpp"

namespace gearpod::mc {

// Standard normal distribution function at z, clamped to [2^-53, 1 - 2^-53].
double standard_normal_cdf(double z);

class Copula {
  public:
    explicit Copula(const Study& study);

    // True if the matrix of the normal variates' correlations (0 for pairs that are not given) is
    // positive definite.
    bool exists() const { return exists_; }
    // True if the study's random input at this index is correlated with another one.
    bool has(std::size_t input) const { return input < has_.size() && has_[input] != 0; }
    // One uniform variate in (0, 1) for each correlated input, in the inputs' order. `normal` gives
    // an independent standard normal variate for each input, by its index in the study.
    std::vector<double> uniform_variates(
        const std::function<double(std::size_t input)>& normal) const;

  private:
    std::vector<std::size_t> inputs_;
    std::vector<char> has_;
    Eigen::MatrixXd factor_;  // lower triangle
    bool exists_ = true;
};

}  // namespace gearpod::mc
