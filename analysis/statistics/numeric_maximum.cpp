#include "analysis/statistics/numeric_maximum.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace gearpod::analysis {
namespace {

using Function = std::function<double(const Eigen::VectorXd&)>;

constexpr double kStep = 1e-4;  // step of the differences, for parameters of order 1

Curvature differences(const Function& function, const Eigen::VectorXd& point, double value) {
    const Eigen::Index n = point.size();
    Curvature curvature{Eigen::VectorXd(n), Eigen::MatrixXd(n, n)};
    const auto moved = [&](Eigen::Index i, double by_i, Eigen::Index j, double by_j) {
        Eigen::VectorXd there = point;
        there[i] += by_i;
        there[j] += by_j;
        return function(there);
    };
    for (Eigen::Index i = 0; i < n; ++i) {
        const double h = kStep * std::max(1.0, std::abs(point[i]));
        const double up = moved(i, h, i, 0.0), down = moved(i, -h, i, 0.0);
        curvature.score[i] = (up - down) / (2.0 * h);
        curvature.information(i, i) = (2.0 * value - up - down) / (h * h);
        for (Eigen::Index j = 0; j < i; ++j) {
            const double k = kStep * std::max(1.0, std::abs(point[j]));
            const double mixed =
                moved(i, h, j, k) - moved(i, h, j, -k) - moved(i, -h, j, k) + moved(i, -h, j, -k);
            curvature.information(i, j) = curvature.information(j, i) = -mixed / (4.0 * h * k);
        }
    }
    return curvature;
}

// Newton's step, damped towards steepest ascent as far as the function is not concave.
Eigen::VectorXd ascent_step(const Curvature& curvature) {
    const double scale = std::max(1e-12, curvature.information.diagonal().cwiseAbs().maxCoeff());
    for (double damping = 0.0; damping < 1e8; damping = damping == 0.0 ? 1e-6 : 10.0 * damping) {
        Eigen::MatrixXd system = curvature.information;
        system.diagonal().array() += damping * scale;
        const Eigen::LLT<Eigen::MatrixXd> solver(system);
        if (solver.info() == Eigen::Success) {
            return solver.solve(curvature.score);
        }
    }
    return curvature.score / scale;
}

// `curvature_at`: of (point, value there).
template <typename CurvatureAt>
NumericMaximum climb(const Function& function, CurvatureAt curvature_at,
                     const Eigen::VectorXd& start) {
    constexpr int kMostSteps = 200;
    constexpr double kConverged = 1e-9;  // gain of a step
    constexpr double kLongest = 2.0;     // longest change of a parameter in one step
    NumericMaximum maximum;
    maximum.at = start;
    maximum.value = function(start);
    for (int step = 0; step < kMostSteps && !maximum.converged; ++step) {
        const Curvature curvature = curvature_at(maximum.at, maximum.value);
        maximum.information = curvature.information;
        if (!curvature.score.allFinite() || !curvature.information.allFinite()) {
            return maximum;
        }
        Eigen::VectorXd move = ascent_step(curvature);
        const double gain = curvature.score.dot(move);
        const double longest = move.cwiseAbs().maxCoeff();
        move *= std::min(1.0, kLongest / longest);
        maximum.converged = gain < kConverged * std::max(1.0, 1e-3 * std::abs(maximum.value));
        bool better = false;
        for (double length = 1.0; length > 1e-10 && !better; length *= 0.5) {
            const Eigen::VectorXd next = maximum.at + length * move;
            const double value = function(next);
            if (value > maximum.value) {
                better = true;
                maximum.at = next;
                maximum.value = value;
            }
        }
        if (!better) {
            maximum.converged = gain < 1e-6 * std::max(1.0, std::abs(maximum.value));
            break;
        }
    }
    return maximum;
}

}  // namespace

NumericMaximum numeric_maximum(const Function& function, const Eigen::VectorXd& start) {
    return climb(
        function,
        [&](const Eigen::VectorXd& point, double value) {
            return differences(function, point, value);
        },
        start);
}

NumericMaximum numeric_maximum(const Function& function,
                               const std::function<Curvature(const Eigen::VectorXd&)>& curvature,
                               const Eigen::VectorXd& start) {
    return climb(
        function, [&](const Eigen::VectorXd& point, double) { return curvature(point); }, start);
}

}  // namespace gearpod::analysis
