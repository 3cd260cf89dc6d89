// Ranks from 1; tied values share their mean rank.
#pragma once

#include <span>
#include <vector>

#include "analysis/statistics/interval.hpp"
#include "machine/fields.hpp"

namespace gearpod::analysis {

std::vector<double> midranks(std::span<const double> values);

// Area under the receiver operating characteristic (AUC): the probability that a faulty gearbox's
// feature lies further to the alarm side than a healthy one's. Ties count half. E. R. DeLong, D. M.
// DeLong, D. L. Clarke-Pearson, Biometrics 44 (1988), 837-845; computed from midranks after X. Sun,
// W. Xu, IEEE Signal Process. Lett. 21 (2014), 1389-1393.

// The area and its structural components per gearbox. Their scatter gives the area's variance.
struct AucComponents {
    double auc = 0.0;
    std::vector<double> healthy;  // per healthy gearbox: share of the faulty ones beyond it
    // Per faulty gearbox: share of the healthy ones that do not reach it.
    std::vector<double> faulty;
};

// Computes the components of samples with larger values on the alarm side.
AucComponents auc_components(std::span<const double> healthy, std::span<const double> faulty);

// Covariance of two areas over the same gearboxes, or with a equal to b the variance. Needs at
// least two gearboxes of either kind.
double auc_covariance(const AucComponents& a, const AucComponents& b);

struct Auc {
    double auc = 0.0;  // NaN if a sample is empty
    Interval bounds;   // two-sided; NaN if a sample has fewer than two gearboxes
    long healthy = 0;
    long faulty = 0;
};
GEARPOD_FIELDS(Auc, auc, lower_upper, healthy, faulty)

// AUC with an interval on the logit scale (M. S. Pepe, The Statistical Evaluation of Medical Tests
// (2003), section 5.2), which stays within 0 and 1. An area of exactly 0 or 1 has no variance; its
// open bound is the Clopper-Pearson bound for min(healthy, faulty) disjoint pairs that all lie on
// one side. Values that are not finite are left out. With `high` false, low values alarm.
Auc auc(std::span<const double> healthy, std::span<const double> faulty, bool high,
        double confidence);

// Interval of an area from its variance, as in auc(). `pairs`: number of disjoint pairs.
Interval auc_interval(double auc, double variance, long pairs, double confidence);

}  // namespace gearpod::analysis
