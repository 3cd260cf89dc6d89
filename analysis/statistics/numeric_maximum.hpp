// Maximum of a smooth function of few parameters by Newton's method, damped where the function is
// not concave. Gradient and Hessian come from central differences unless the caller has them.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace gearpod::analysis {

struct NumericMaximum {
    Eigen::VectorXd at;
    double value = 0.0;
    Eigen::MatrixXd information;  // negative Hessian
    bool converged = false;
};

// Gradient and negative Hessian of a function.
struct Curvature {
    Eigen::VectorXd score;
    Eigen::MatrixXd information;
};

// Maximises `function` from `start`. Parameters should be of order 1. The function may return
// -infinity or NaN where it is undefined, but not at `start`.
NumericMaximum numeric_maximum(const std::function<double(const Eigen::VectorXd&)>& function,
                               const Eigen::VectorXd& start);
NumericMaximum numeric_maximum(const std::function<double(const Eigen::VectorXd&)>& function,
                               const std::function<Curvature(const Eigen::VectorXd&)>& curvature,
                               const Eigen::VectorXd& start);

}  // namespace gearpod::analysis
