// The maximum of a smooth function of few parameters, by Newton's steps with slopes and curvature
// from central differences, damped where the function is not concave.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace gearpod::analysis {

struct NumericMaximum {
    Eigen::VectorXd at;
    double value = 0.0;
    Eigen::MatrixXd information;  // the negative second derivatives
    bool converged = false;
};

// Parameters should be of order 1. The function may be -infinity or NaN where it has no value, but
// not at `start`.
NumericMaximum numeric_maximum(const std::function<double(const Eigen::VectorXd&)>& function,
                               const Eigen::VectorXd& start);

}  // namespace gearpod::analysis
