#include "analysis/statistics/noncentral_distributions.hpp"

#include <boost/math/distributions/non_central_t.hpp>

#include "analysis/statistics/quiet_policy.hpp"

namespace gearpod::analysis {
namespace {

using NoncentralT = boost::math::non_central_t_distribution<double, QuietPolicy>;

}  // namespace

double noncentral_t_cdf(double freedom, double noncentrality, double value) {
    return boost::math::cdf(NoncentralT(freedom, noncentrality), value);
}

double noncentral_t_upper_tail(double freedom, double noncentrality, double value) {
    return boost::math::cdf(boost::math::complement(NoncentralT(freedom, noncentrality), value));
}

}  // namespace gearpod::analysis
