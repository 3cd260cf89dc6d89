// Covariance of a hit/miss curve's intercept and slope from the curve's information. The robust
// covariance is for clustered outcomes (one specimen inspected several times): the scores summed
// over each cluster between two inverse informations, times clusters / (clusters - 1). K.-Y. Liang,
// S. L. Zeger, Biometrika 73 (1986), 13-22.
#pragma once

#include <Eigen/Core>
#include <span>

#include "analysis/pod/pod_curve.hpp"

namespace gearpod::analysis {

struct ClusteredOutcome {
    double size = 0.0;
    bool hit = false;
    long cluster = 0;
};

// Robust covariance if `by_cluster`. NaN if the outcomes do not determine both parameters. The
// curve must not have a fitted ceiling.
Eigen::Matrix2d curve_covariance(std::span<const ClusteredOutcome> outcomes, const PodCurve& curve,
                                 bool by_cluster);

}  // namespace gearpod::analysis
