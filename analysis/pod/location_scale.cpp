#include "analysis/pod/location_scale.hpp"

#include <cmath>
#include <limits>

#include "analysis/statistics/interval.hpp"

namespace gearpod::analysis {
namespace {

double eta_of(const PodForm& form, double pod) {
    return link_quantile(form.link, (pod - form.floor) / (1.0 - form.floor));
}

}  // namespace

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

}  // namespace gearpod::analysis
