#include "analysis/pod/cluster_effect.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "analysis/pod/location_scale.hpp"
#include "analysis/statistics/distributions.hpp"

namespace gearpod::analysis {

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
