// A POD curve as location and scale of the size, POD = F((x - location) / scale), with their
// covariance, and Wald's bounds of what is read off it (MIL-HDBK-1823A, appendix G.2.5).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/pod/pod_curve.hpp"
#include "analysis/pod/size_estimate.hpp"

namespace gearpod::analysis {

struct LocationScale {
    double location = 0.0;  // x where eta is 0: the median of logit and probit, 63 % of cloglog
    double scale = 0.0;     // x per eta, > 0
    Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();

    // x at eta, `z` standard errors above its estimate.
    double at(double eta, double z) const;
    // The eta whose x is so many standard errors below the given one: that of the bound of POD at x
    // from which `at(eta, z)` is x. Infinite where the bound is open.
    double eta_at(double x, double z) const;
};

// Of eta = intercept + slope x, with the covariance of the two; slope > 0.
LocationScale location_scale(double intercept, double slope, const Eigen::Matrix2d& covariance);

// Wald's bounds at `z` standard errors, within the sizes tested.
SizeBounds wald_size_bounds(const LocationScale& curve, const PodForm& form, double pod, double z,
                            double smallest, double largest);
std::vector<PodPoint> wald_band(const LocationScale& curve, const PodForm& form, double z,
                                const std::vector<double>& sizes);

// How many times the tested specimens it takes for the upper bound of the size with this POD to
// come down to `size`: the square of its standard errors against the distance; infinite where the
// curve itself does not.
double wald_specimens(const LocationScale& curve, const PodForm& form, double pod, double size,
                      double z);

}  // namespace gearpod::analysis
