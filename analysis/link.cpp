#include "analysis/link.hpp"

#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <limits>
#include <numbers>

namespace gearpod::analysis {

double link_probability(Link link, double eta) {
    if (link == Link::logit) {
        // Without cancellation for small probabilities.
        const double e = std::exp(-std::abs(eta));
        return (eta > 0.0 ? 1.0 : e) / (1.0 + e);
    }
    return 0.5 * std::erfc(-eta / std::numbers::sqrt2);
}

double link_density(Link link, double eta) {
    if (link == Link::logit) {
        const double e = std::exp(-std::abs(eta));
        return e / ((1.0 + e) * (1.0 + e));
    }
    return std::exp(-0.5 * eta * eta) * std::numbers::inv_sqrtpi / std::numbers::sqrt2;
}

double link_quantile(Link link, double probability) {
    if (!(probability > 0.0 && probability < 1.0)) {
        return probability == 0.0   ? -std::numeric_limits<double>::infinity()
               : probability == 1.0 ? std::numeric_limits<double>::infinity()
                                    : std::numeric_limits<double>::quiet_NaN();
    }
    if (link == Link::logit) {
        return std::log(probability) - std::log1p(-probability);
    }
    return -std::numbers::sqrt2 * boost::math::erfc_inv(2.0 * probability);
}

const char* link_name(Link link) {
    return link == Link::logit ? "logit" : "probit";
}

}  // namespace gearpod::analysis
