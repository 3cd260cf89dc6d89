#include "analysis/statistics/link.hpp"

#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "analysis/statistics/quiet_policy.hpp"

namespace gearpod::analysis {

LinkValues link_values(Link link, double eta) {
    const double away = std::abs(eta);
    double small = 0.0, density = 0.0;
    if (link == Link::logit) {
        const double e = std::exp(-away);
        small = e / (1.0 + e);
        density = small / (1.0 + e);
    } else {
        small = 0.5 * std::erfc(away / std::numbers::sqrt2);
        density = std::exp(-0.5 * eta * eta) * std::numbers::inv_sqrtpi / std::numbers::sqrt2;
    }
    return eta > 0.0 ? LinkValues{1.0 - small, small, density}
                     : LinkValues{small, 1.0 - small, density};
}

double link_probability(Link link, double eta) {
    return link_values(link, eta).up;
}

double link_density(Link link, double eta) {
    return link_values(link, eta).density;
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
    return -std::numbers::sqrt2 * boost::math::erfc_inv(2.0 * probability, QuietPolicy());
}

const char* link_name(Link link) {
    return link == Link::logit ? "logit" : "probit";
}

}  // namespace gearpod::analysis
