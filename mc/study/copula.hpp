// Random inputs that go together: a Gaussian copula, which leaves every input its own distribution.
// Normals with correlations r have rank correlations (6 / pi) asin(r / 2), whatever increasing
// functions are then applied to them: K. Pearson, Drapers' Company Research Memoirs IV (1907);
// W. H. Kruskal, J. Am. Stat. Assoc. 53 (1958), 814-861.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "mc/study/study.hpp"

namespace gearpod::mc {

// Of standard normal numbers, that is not above z: inside (0, 1).
double share_below(double z);

class Copula {
  public:
    explicit Copula(const Study& study);

    // Whether there are such normals: the matrix of their correlations, of pairs that are not
    // given 0, is positive definite.
    bool exists() const { return exists_; }
    // Of the study's random input at a place.
    bool has(std::size_t input) const { return input < has_.size() && has_[input] != 0; }
    // Where each correlated input lies in its distribution, 0 < share < 1, in the inputs' order;
    // from a normal number for each, by its place in the study.
    std::vector<double> shares(const std::function<double(std::size_t input)>& normal) const;

  private:
    std::vector<std::size_t> inputs_;
    std::vector<char> has_;
    Eigen::MatrixXd factor_;  // lower triangle
    bool exists_ = true;
};

}  // namespace gearpod::mc
