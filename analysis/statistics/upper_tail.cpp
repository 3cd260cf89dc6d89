#include "analysis/statistics/upper_tail.hpp"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <cmath>

#include "analysis/statistics/quiet_policy.hpp"

namespace gearpod::analysis {
namespace {

template <typename Law>
double upper_tail(const Law& law, double statistic) {
    if (!(statistic > 0.0)) {
        return std::isnan(statistic) ? statistic : 1.0;
    }
    return std::isinf(statistic) ? 0.0 : boost::math::cdf(boost::math::complement(law, statistic));
}

}  // namespace

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
