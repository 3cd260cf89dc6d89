#include "analysis/statistics/distributions.hpp"

#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/gamma.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include "analysis/statistics/quiet_policy.hpp"

namespace gearpod::analysis {
namespace {

using Normal = boost::math::normal_distribution<double, QuietPolicy>;
using Student = boost::math::students_t_distribution<double, QuietPolicy>;
using Beta = boost::math::beta_distribution<double, QuietPolicy>;
using Gamma = boost::math::gamma_distribution<double, QuietPolicy>;
using Binomial = boost::math::binomial_distribution<double, QuietPolicy>;

}  // namespace

double normal_cdf(double value) {
    return boost::math::cdf(Normal(), value);
}

double normal_quantile(double probability) {
    return boost::math::quantile(Normal(), probability);
}

double normal_upper_quantile(double tail) {
    return boost::math::quantile(boost::math::complement(Normal(), tail));
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

}  // namespace gearpod::analysis
