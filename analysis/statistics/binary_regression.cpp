#include "analysis/statistics/binary_regression.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gearpod::analysis {
namespace {

struct Slopes {
    double log_likelihood = 0.0;
    Eigen::VectorXd score;
    Eigen::MatrixXd information;
};

Slopes evaluate(const Eigen::MatrixXd& design, std::span<const char> yes, const OutcomeCurve& model,
                const Eigen::VectorXd& b) {
    const Eigen::VectorXd eta = design * b;
    Eigen::VectorXd logarithm(eta.size()), left(eta.size()), weight(eta.size());
    outcome_terms(model, eta.size(), eta.data(), yes.data(), logarithm.data(), left.data(),
                  weight.data());
    Slopes slopes;
    slopes.log_likelihood = logarithm.sum();
    slopes.score = design.transpose() * left;
    slopes.information = design.transpose() * weight.asDiagonal() * design;
    return slopes;
}

// Fisher scoring from `b` until the gain of a further step is negligible. False if no maximum is
// found within the limits.
bool ascend(const Eigen::MatrixXd& design, std::span<const char> yes, const OutcomeCurve& model,
            Eigen::VectorXd& b, Slopes& here) {
    constexpr int kMostSteps = 200;
    constexpr double kConverged = 1e-10;  // gain of the log likelihood
    constexpr double kFarthest = 1e3;     // largest coefficient, for covariates of order 1
    for (int step = 0; step < kMostSteps; ++step) {
        const Eigen::VectorXd move = here.information.ldlt().solve(here.score);
        const double gain = here.score.dot(move);
        if (!std::isfinite(gain) || b.cwiseAbs().maxCoeff() > kFarthest) {
            return false;
        }
        if (gain < kConverged) {
            return true;
        }
        bool better = false;
        for (double length = 1.0; length > 1e-8 && !better; length *= 0.5) {
            const Eigen::VectorXd next = b + length * move;
            Slopes there = evaluate(design, yes, model, next);
            if (there.log_likelihood >
                here.log_likelihood - 1e-14 * std::abs(here.log_likelihood)) {
                better = true;
                b = next;
                here = std::move(there);
            }
        }
        if (!better) {
            return gain < 1e-6;
        }
    }
    return false;
}

}  // namespace

BinaryFit fit_binary(const Eigen::MatrixXd& design, std::span<const char> yes,
                     const OutcomeCurve& model, const Eigen::VectorXd& start) {
    if (design.rows() != static_cast<Eigen::Index>(yes.size()) || design.cols() == 0) {
        throw std::invalid_argument("binary regression: needs one row of the design per outcome");
    }
    BinaryFit fit;
    const auto count = static_cast<double>(yes.size());
    const auto hits = static_cast<double>(
        std::count_if(yes.begin(), yes.end(), [](char outcome) { return outcome != 0; }));
    if (hits == 0.0 || hits == count) {
        fit.refusal = count == 0.0 ? "no gearboxes" : "all outcomes are equal";
        return fit;
    }
    const double share =
        std::clamp((hits / count - model.floor) / (model.ceiling - model.floor), 0.01, 0.99);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(design.cols());
    b[0] = link_quantile(model.link, share);
    b.head(start.size()) = start;
    Slopes here = evaluate(design, yes, model, b);
    if (!ascend(design, yes, model, b, here)) {
        fit.refusal = "the maximum-likelihood fit does not converge";
        return fit;
    }
    const Eigen::LDLT<Eigen::MatrixXd> solver(here.information);
    const Eigen::VectorXd pivots = solver.vectorD();
    if (pivots.minCoeff() <= 1e-10 * pivots.maxCoeff()) {
        fit.refusal = "the outcomes do not determine all coefficients";
        return fit;
    }
    fit.coefficients = b;
    fit.covariance = solver.solve(Eigen::MatrixXd::Identity(design.cols(), design.cols()));
    fit.log_likelihood = here.log_likelihood;
    return fit;
}

}  // namespace gearpod::analysis
