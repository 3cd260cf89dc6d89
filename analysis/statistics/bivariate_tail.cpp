#include "analysis/statistics/bivariate_tail.hpp"

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <numbers>

#include "analysis/statistics/quiet_policy.hpp"

namespace gearpod::analysis {

double normal_upper_tail(double z) {
    return 0.5 * std::erfc(z / std::numbers::sqrt2);
}

double normal_upper_tail_quantile(double p) {
    return std::numbers::sqrt2 * boost::math::erfc_inv(2.0 * p, QuietPolicy());
}

double both_exceed(double rate, double share) {
    if (share <= 0.0) {
        return rate * rate;
    }
    constexpr double kReach = 9.0;
    constexpr int kSteps = 600;
    const double z = normal_upper_tail_quantile(rate), own = std::sqrt(std::max(1e-9, 1.0 - share));
    double sum = 0.0;
    for (int i = 0; i <= kSteps; ++i) {
        const double m = kReach * (2.0 * i / kSteps - 1.0);
        const double one = normal_upper_tail((z - std::sqrt(share) * m) / own);
        sum += std::exp(-0.5 * m * m) * one * one;
    }
    return sum * 2.0 * kReach / kSteps / std::sqrt(2.0 * std::numbers::pi);
}

}  // namespace gearpod::analysis
