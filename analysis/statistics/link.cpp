#include "analysis/statistics/link.hpp"

#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "analysis/statistics/quiet_policy.hpp"
#include "machine/no_value.hpp"

namespace gearpod::analysis {

namespace {

// Values of 1 - exp(-exp(eta)).
LinkValues cloglog_values(double eta) {
    const double rate = std::exp(eta);
    const double down = std::exp(-rate);
    return {-std::expm1(-rate), down, std::isinf(rate) ? 0.0 : rate * down};
}

// F at a distance `away` below the middle.
double symmetric_tail(Link link, double away) {
    if (link == Link::probit) {
        return 0.5 * std::erfc(away / std::numbers::sqrt2);
    }
    const double e = std::exp(-away);
    return e / (1.0 + e);
}

LinkValues symmetric_values(Link link, double eta) {
    const double small = symmetric_tail(link, std::abs(eta));
    const double density = link == Link::logit ? small * (1.0 - small)
                                               : std::exp(-0.5 * eta * eta) *
                                                     std::numbers::inv_sqrtpi / std::numbers::sqrt2;
    return eta > 0.0 ? LinkValues{1.0 - small, small, density}
                     : LinkValues{small, 1.0 - small, density};
}

}  // namespace

LinkValues link_values(Link link, double eta) {
    switch (link) {
        case Link::logit:
        case Link::probit:
            break;
        case Link::cloglog:
            return cloglog_values(eta);
        case Link::loglog: {
            const LinkValues mirrored = cloglog_values(-eta);
            return {mirrored.down, mirrored.up, mirrored.density};
        }
    }
    return symmetric_values(link, eta);
}

double link_probability(Link link, double eta) {
    if (link == Link::logit || link == Link::probit) {
        const double small = symmetric_tail(link, std::abs(eta));
        return eta > 0.0 ? 1.0 - small : small;
    }
    return link_values(link, eta).up;
}

double link_density(Link link, double eta) {
    return link_values(link, eta).density;
}

double link_quantile(Link link, double probability) {
    if (!(probability > 0.0 && probability < 1.0)) {
        return probability == 0.0   ? -std::numeric_limits<double>::infinity()
               : probability == 1.0 ? std::numeric_limits<double>::infinity()
                                    : kNan;
    }
    switch (link) {
        case Link::logit:
            return std::log(probability) - std::log1p(-probability);
        case Link::cloglog:
            return std::log(-std::log1p(-probability));
        case Link::loglog:
            return -std::log(-std::log(probability));
        case Link::probit:
            break;
    }
    return -std::numbers::sqrt2 * boost::math::erfc_inv(2.0 * probability, QuietDoublePolicy());
}

double link_upper_quantile(Link link, double probability) {
    const Link mirrored = link == Link::cloglog  ? Link::loglog
                          : link == Link::loglog ? Link::cloglog
                                                 : link;
    return -link_quantile(mirrored, probability);
}

const char* link_name(Link link) {
    switch (link) {
        case Link::logit:
            return "logit";
        case Link::probit:
            return "probit";
        case Link::cloglog:
            return "cloglog";
        case Link::loglog:
            break;
    }
    return "loglog";
}

}  // namespace gearpod::analysis
