#include "analysis/pod/curve_covariance.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <map>

#include "analysis/statistics/interval.hpp"

namespace gearpod::analysis {

Eigen::Matrix2d curve_covariance(std::span<const ClusteredOutcome> outcomes, const PodCurve& curve,
                                 bool by_cluster) {
    constexpr double kTiny = 1e-290;
    const PodForm& form = curve.form;
    Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
    std::map<long, Eigen::Vector2d> scores;
    for (const ClusteredOutcome& outcome : outcomes) {
        const double x = form.scaled(outcome.size);
        const LinkValues at = link_values(form.link, curve.intercept + curve.slope * x);
        const double rise = curve.ceiling - form.floor;
        const double hit = form.floor + rise * at.up;
        const double miss = (1.0 - curve.ceiling) + rise * at.down;
        const double by_eta = rise * at.density;
        const double both = std::max(kTiny, hit * miss);
        const Eigen::Vector2d row(1.0, x);
        information += by_eta * by_eta / both * row * row.transpose();
        const double left =
            outcome.hit ? by_eta / std::max(kTiny, hit) : -by_eta / std::max(kTiny, miss);
        scores.try_emplace(outcome.cluster, Eigen::Vector2d::Zero()).first->second += left * row;
    }
    const Eigen::FullPivLU<Eigen::Matrix2d> solver(information);
    if (!solver.isInvertible()) {
        return Eigen::Matrix2d::Constant(kNan);
    }
    const Eigen::Matrix2d inverse = solver.inverse();
    if (!by_cluster || scores.size() < 2) {
        return inverse;
    }
    Eigen::Matrix2d middle = Eigen::Matrix2d::Zero();
    for (const auto& [cluster, score] : scores) {
        middle += score * score.transpose();
    }
    const auto clusters = static_cast<double>(scores.size());
    return clusters / (clusters - 1.0) * inverse * middle * inverse;
}

}  // namespace gearpod::analysis
