// Regression of binary outcomes on several covariates: P(yes) = floor + (ceiling - floor) F(design
// * b), with given floor and ceiling. Fisher scoring with step halving: P. McCullagh, J. A. Nelder,
// Generalized Linear Models (1989), section 2.5.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>

#include "analysis/statistics/outcome_terms.hpp"

namespace gearpod::analysis {

struct BinaryFit {
    Eigen::VectorXd coefficients;
    Eigen::MatrixXd covariance;  // inverse of the Fisher information
    double log_likelihood = 0.0;
    std::string refusal;  // reason why there is no fit, or ""
};

// Fits the model. `design`: outcomes x coefficients, its first column 1; the others should be of
// order 1. `start`: initial values of the first coefficients, from a fit with fewer.
BinaryFit fit_binary(const Eigen::MatrixXd& design, std::span<const char> yes,
                     const OutcomeCurve& model, const Eigen::VectorXd& start = {});

}  // namespace gearpod::analysis
