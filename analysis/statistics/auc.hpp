// Area under the receiver operating characteristic: the probability that a faulty gearbox's feature
// lies further to the alarm side than a healthy one's, ties counting half.
// E. R. DeLong, D. M. DeLong, D. L. Clarke-Pearson, Biometrics 44 (1988), 837-845; by midranks as
// X. Sun, W. Xu, IEEE Signal Process. Lett. 21 (2014), 1389-1393.
#pragma once

#include <span>
#include <vector>

#include "analysis/statistics/interval.hpp"

namespace gearpod::analysis {

// The area and the share that each gearbox has in it; the shares' scatter is the area's.
struct AucShares {
    double auc = 0.0;
    std::vector<double> healthy;  // per healthy gearbox: faulty ones beyond it, as a share
    std::vector<double> faulty;   // per faulty gearbox: healthy ones short of it, as a share
};

// Values must be finite and are larger on the alarm side. Both samples at least 1.
AucShares auc_shares(std::span<const double> healthy, std::span<const double> faulty);

// Covariance of two areas over the same gearboxes; the variance of one with itself. Needs two
// gearboxes of either kind.
double auc_covariance(const AucShares& a, const AucShares& b);

struct Auc {
    double auc = 0.0;  // NaN if a sample is empty
    Interval bounds;   // two-sided; NaN if a sample has fewer than two gearboxes
    long healthy = 0;
    long faulty = 0;
};

// Interval on the logit scale (M. S. Pepe, The Statistical Evaluation of Medical Tests (2003),
// section 5.2), which stays within 0 and 1. An area of exactly 0 or 1 has no scatter of its own;
// its open bound is the Clopper-Pearson one of min(healthy, faulty) disjoint pairs all on one side.
// Values that are not finite are left out; `high` false: low values alarm.
Auc auc(std::span<const double> healthy, std::span<const double> faulty, bool high,
        double confidence);

// Interval of an area from its variance, as above; `pairs`: disjoint pairs.
Interval auc_interval(double auc, double variance, long pairs, double confidence);

}  // namespace gearpod::analysis
