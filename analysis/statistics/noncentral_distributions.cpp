#include "analysis/statistics/noncentral_distributions.hpp"

#include <algorithm>
#include <boost/math/distributions/non_central_f.hpp>
#include <boost/math/distributions/non_central_t.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>

#include "analysis/statistics/gauss_rule.hpp"
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

namespace {

// Limits beyond which large_noncentrality_cdf() replaces Boost. Boost sums several multiples of the
// square root of the noncentrality in terms and counts them in an int.
constexpr double kLarge = 1e5;
constexpr double kOfFreedom = 100.0;

// Approximation for large noncentrality. The square root of the numerator is then nearly normal;
// its mean and variance are chosen such that its square has the noncentral distribution's mean and
// variance. It scatters far less than the denominator, so the expectation of the central
// distribution over it is that of a smooth function.
double large_noncentrality_cdf(double f, double numerator, double denominator,
                               double noncentrality) {
    static const GaussRule rule = normal_gauss_rule(24);
    const double mean = noncentrality + numerator;
    const double half_variance = 2.0 * noncentrality + numerator;
    const double spread_squared =
        half_variance / (mean + std::sqrt(mean * mean - half_variance));  // of the root
    const double centre = std::sqrt(mean - spread_squared), spread = std::sqrt(spread_squared);
    double probability = 0.0;
    for (Eigen::Index i = 0; i < rule.nodes.size(); ++i) {
        const double root = centre + spread * rule.nodes[i];
        // Least value of the denominator.
        const double least = denominator * (root / (numerator * f)) * root;
        probability +=
            rule.weights[i] * boost::math::gamma_q(0.5 * denominator, 0.5 * least, QuietPolicy());
    }
    return std::min(probability, 1.0);
}

}  // namespace

double noncentral_f_cdf(double f, double numerator, double denominator, double noncentrality) {
    if (noncentrality > std::max(kLarge, kOfFreedom * denominator)) {
        return f > 0.0 ? large_noncentrality_cdf(f, numerator, denominator, noncentrality) : 0.0;
    }
    using Policy =
        boost_policies::normalise<QuietPolicy, boost_policies::promote_double<false>>::type;
    return boost::math::cdf(boost::math::non_central_f_distribution<double, Policy>(
                                numerator, denominator, noncentrality),
                            f);
}

}  // namespace gearpod::analysis
