#include "analysis/statistics/distributions.hpp"

#include <algorithm>
#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/gamma.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/owens_t.hpp>
#include <cmath>
#include <numbers>

#include "analysis/statistics/quiet_policy.hpp"

namespace gearpod::analysis {
namespace {

using Normal = boost::math::normal_distribution<double, QuietPolicy>;
using Student = boost::math::students_t_distribution<double, QuietPolicy>;
using Beta = boost::math::beta_distribution<double, QuietPolicy>;
using Gamma = boost::math::gamma_distribution<double, QuietPolicy>;
using Binomial = boost::math::binomial_distribution<double, QuietPolicy>;

template <typename Law>
double upper_tail(const Law& law, double statistic) {
    if (!(statistic > 0.0)) {
        return std::isnan(statistic) ? statistic : 1.0;
    }
    return std::isinf(statistic) ? 0.0 : boost::math::cdf(boost::math::complement(law, statistic));
}

}  // namespace

double normal_cdf(double value) {
    return boost::math::cdf(Normal(), value);
}

double normal_quantile(double probability) {
    return boost::math::quantile(Normal(), probability);
}

double normal_upper_tail(double value) {
    return 0.5 * std::erfc(value / std::numbers::sqrt2);
}

double normal_upper_quantile(double tail) {
    return boost::math::quantile(boost::math::complement(Normal(), tail));
}

// D. B. Owen, Tables for computing bivariate normal probabilities, Ann. Math. Statist. 27 (1956),
// Eq. 2.1 for equal limits. The correlation raises the probability of independent values.
double both_exceed(double rate, double correlation) {
    if (correlation <= 0.0) {
        return rate * rate;
    }
    const double slope = std::sqrt((1.0 - correlation) / (1.0 + correlation));
    const double beyond = boost::math::owens_t(normal_upper_quantile(rate), slope, QuietPolicy());
    return std::max(rate * rate, rate - 2.0 * beyond);
}

double student_quantile(double freedom, double probability) {
    return boost::math::quantile(Student(freedom), probability);
}

double beta_cdf(double a, double b, double value) {
    return boost::math::ibeta(a, b, value, QuietPolicy());
}

double beta_quantile(double a, double b, double probability) {
    return boost::math::quantile(Beta(a, b), probability);
}

double beta_upper_quantile(double a, double b, double tail) {
    return boost::math::quantile(boost::math::complement(Beta(a, b), tail));
}

double gamma_quantile(double shape, double scale, double probability) {
    return boost::math::quantile(Gamma(shape, scale), probability);
}

double gamma_upper_quantile(double shape, double scale, double tail) {
    return boost::math::quantile(boost::math::complement(Gamma(shape, scale), tail));
}

double binomial_cdf(double tried, double rate, double found) {
    return boost::math::cdf(Binomial(tried, rate), found);
}

double log_gamma(double value) {
    return boost::math::lgamma(value, QuietPolicy());
}

double chi_squared_upper_tail(double statistic, double degrees) {
    return upper_tail(boost::math::chi_squared_distribution<double, QuietPolicy>(degrees),
                      statistic);
}

double f_upper_tail(double statistic, double numerator_degrees, double denominator_degrees) {
    return upper_tail(boost::math::fisher_f_distribution<double, QuietPolicy>(numerator_degrees,
                                                                              denominator_degrees),
                      statistic);
}

}  // namespace gearpod::analysis
