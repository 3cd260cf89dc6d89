#include "analysis/pod/pod_curve.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "analysis/statistics/distributions.hpp"
#include "machine/contracts.hpp"

namespace gearpod::analysis {
namespace {

double square(double value) {
    return value * value;
}

double eta_of(const PodForm& form, double pod) {
    return link_quantile(form.link, (pod - form.floor) / (1.0 - form.floor));
}

}  // namespace

double BoundRule::limit() const {
    return std::sqrt(chi_squared);
}

BoundRule one_sided_bound(double confidence, BoundMethod method) {
    return {method, square(link_quantile(Link::probit, confidence))};
}

BoundRule two_sided_bound(double confidence, BoundMethod method) {
    return {method, square(link_quantile(Link::probit, 0.5 * (1.0 + confidence)))};
}

BoundRule joint_bound(double confidence, BoundMethod method) {
    return {method, -2.0 * std::log1p(-confidence)};
}

std::string bound_text(const BoundRule& rule) {
    switch (rule.method) {
        case BoundMethod::wald:
            return fmt::format("Wald, {:.4g} standard errors", rule.limit());
        case BoundMethod::calibrated:
            return "calibrated on simulated tables";
        case BoundMethod::exact:
            return "exact, noncentral t distribution";
        case BoundMethod::likelihood_ratio:
            break;
    }
    return fmt::format("likelihood ratio, chi-squared {:.4g}", rule.chi_squared);
}

double PodForm::scaled(double size) const {
    return log_size ? std::log(size) : size;
}

double PodForm::size(double scaled) const {
    return log_size ? std::exp(scaled) : scaled;
}

std::string form_text(const PodForm& form) {
    std::string text =
        fmt::format("{} of {}", link_name(form.link), form.log_size ? "log size" : "size");
    if (form.floor > 0.0) {
        text += fmt::format(", floor {:.3g}", form.floor);
    }
    if (form.free_ceiling) {
        text += ", ceiling fitted";
    }
    if (form.firth) {
        text += ", Firth's penalty";
    }
    return text;
}

double PodCurve::pod(double size) const {
    const double eta = intercept + slope * form.scaled(size);
    return form.floor + (ceiling - form.floor) * link_probability(form.link, eta);
}

std::optional<double> PodCurve::size_at(double pod) const {
    if (!(pod > form.floor && pod < ceiling && slope > 0.0)) {
        return std::nullopt;
    }
    const double eta = link_quantile(form.link, (pod - form.floor) / (ceiling - form.floor));
    return form.size((eta - intercept) / slope);
}

Eigen::Matrix2d curve_covariance(std::span<const ClusteredOutcome> outcomes, const PodCurve& curve,
                                 bool by_cluster) {
    EXPECTS(!curve.form.free_ceiling);
    constexpr double kTiny = 1e-290;
    const PodForm& form = curve.form;
    Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
    std::map<long, Eigen::Vector2d> scores;
    for (const ClusteredOutcome& outcome : outcomes) {
        const double x = form.scaled(outcome.size);
        const LinkValues link = link_values(form.link, curve.intercept + curve.slope * x);
        const double rise = curve.ceiling - form.floor;
        const double hit = form.floor + rise * link.up;
        const double miss = (1.0 - curve.ceiling) + rise * link.down;
        const double by_eta = rise * link.density;
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

double LocationScale::at(double eta, double z) const {
    const double variance =
        covariance(0, 0) + 2.0 * eta * covariance(0, 1) + eta * eta * covariance(1, 1);
    return location + eta * scale + z * std::sqrt(variance);
}

double LocationScale::eta_at(double x, double z) const {
    if (z == 0.0) {
        return (x - location) / scale;
    }
    // (x - location - eta scale)^2 = z^2 variance(eta); the lower root belongs to z > 0.
    const double a = scale * scale - z * z * covariance(1, 1);
    const double b = -2.0 * (scale * (x - location) + z * z * covariance(0, 1));
    const double c = (x - location) * (x - location) - z * z * covariance(0, 0);
    const double inside = b * b - 4.0 * a * c;
    if (!(a > 0.0 && inside >= 0.0)) {  // the slope is not significant
        return z > 0.0 ? -std::numeric_limits<double>::infinity()
                       : std::numeric_limits<double>::infinity();
    }
    return (-b + (z > 0.0 ? -1.0 : 1.0) * std::sqrt(inside)) / (2.0 * a);
}

LocationScale location_scale(double intercept, double slope, const Eigen::Matrix2d& covariance) {
    EXPECTS(slope > 0.0);
    LocationScale curve{-intercept / slope, 1.0 / slope, {}};
    Eigen::Matrix2d by;
    by << -1.0 / slope, intercept / (slope * slope), 0.0, -1.0 / (slope * slope);
    curve.covariance = by * covariance * by.transpose();
    return curve;
}

SizeBounds wald_size_bounds(const LocationScale& curve, const PodForm& form, double pod, double z,
                            double smallest, double largest) {
    // A curve at its floor already reaches lower rates.
    if (!(pod > form.floor)) {
        const SizeEstimate below{SizeEstimate::Where::below_tested, kNan};
        return {below, below, below};
    }
    const double eta = eta_of(form, pod);
    const auto bound = [&](double errors) {
        return estimate_within(form.size(curve.at(eta, errors)), smallest, largest);
    };
    return {bound(0.0), bound(-z), bound(z)};
}

std::vector<PodPoint> wald_band(const LocationScale& curve, const PodForm& form, double z,
                                const std::vector<double>& sizes) {
    std::vector<PodPoint> band;
    for (const double size : sizes) {
        const auto pod = [&](double errors) {
            const double eta = curve.eta_at(form.scaled(size), errors);
            return form.floor + (1.0 - form.floor) * link_probability(form.link, eta);
        };
        band.push_back({size, pod(0.0), pod(z), pod(-z)});
    }
    return band;
}

double wald_specimens(const LocationScale& curve, const PodForm& form, double pod, double size,
                      double z) {
    const double eta = eta_of(form, pod);
    const double clear = form.scaled(size) - curve.at(eta, 0.0);
    const double half_width = curve.at(eta, z) - curve.at(eta, 0.0);
    return clear > 0.0 ? std::pow(half_width / clear, 2) : std::numeric_limits<double>::infinity();
}

long count_clusters(std::span<const ClusteredOutcome> outcomes) {
    std::set<long> clusters;
    for (const ClusteredOutcome& outcome : outcomes) {
        clusters.insert(outcome.cluster);
    }
    return static_cast<long>(clusters.size());
}

double design_effect(std::span<const ClusteredOutcome> outcomes, const PodCurve& curve) {
    double effect = 1.0;
    const LocationScale robust =
        location_scale(curve.intercept, curve.slope, curve_covariance(outcomes, curve, true));
    const LocationScale independent =
        location_scale(curve.intercept, curve.slope, curve_covariance(outcomes, curve, false));
    for (const double pod : {0.5, 0.9}) {
        const double eta = link_quantile(curve.form.link, pod);
        const double ratio = (robust.at(eta, 1.0) - robust.at(eta, 0.0)) /
                             (independent.at(eta, 1.0) - independent.at(eta, 0.0));
        effect = std::isfinite(ratio) ? std::max(effect, ratio * ratio) : effect;
    }
    return effect;
}

double clustered_chi_squared(double effect, long clusters, double confidence) {
    const double limit = student_quantile(static_cast<double>(clusters - 2), confidence);
    return effect * limit * limit;
}

}  // namespace gearpod::analysis
