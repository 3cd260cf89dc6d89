// POD curve in terms of location and scale of the size, POD = F((x - location) / scale), with their
// covariance and Wald bounds of derived quantities (MIL-HDBK-1823A, appendix G.2.5).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/pod/pod_curve.hpp"
#include "analysis/pod/size_estimate.hpp"

namespace gearpod::analysis {

struct LocationScale {
    double location = 0.0;  // x where eta is 0: the median for logit and probit, 63 % for cloglog
    double scale = 0.0;     // x per eta, > 0
    Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();

    // x at eta, plus `z` standard errors.
    double at(double eta, double z) const;
    // Inverse of at(): the eta with at(eta, z) = x, which gives the bound of POD at x. Infinite
    // where the bound is open.
    double eta_at(double x, double z) const;
};

// Location and scale of eta = intercept + slope x with the covariance of the two; slope > 0.
LocationScale location_scale(double intercept, double slope, const Eigen::Matrix2d& covariance);

// Wald bounds at `z` standard errors, within the tested sizes.
SizeBounds wald_size_bounds(const LocationScale& curve, const PodForm& form, double pod, double z,
                            double smallest, double largest);
std::vector<PodPoint> wald_band(const LocationScale& curve, const PodForm& form, double z,
                                const std::vector<double>& sizes);

// Number of specimens needed to bring the upper bound of the size with this POD to `size`, as a
// factor on the number tested: the square of the ratio of the bound's half-width to the distance
// between `size` and the estimate. Infinite if the curve itself lies above `size`.
double wald_specimens(const LocationScale& curve, const PodForm& form, double pod, double size,
                      double z);

}  // namespace gearpod::analysis
