#include "analysis/monitoring/monitor_ranking.hpp"

#include <cmath>
#include <limits>
#include <tuple>

#include "analysis/statistics/distributions.hpp"

namespace gearpod::analysis {
namespace {

// Values that do not exist come last.
double or_last(double value) {
    return std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
}

// Probability that chance finds as many cracks or more.
double chance_of(const MonitorPerformance& performance) {
    const double share = std::fmax(performance.share_by_chance, performance.share_at_stated_rate);
    return performance.found == 0
               ? 1.0
               : 1.0 - binomial_cdf(static_cast<double>(performance.ended), share,
                                    static_cast<double>(performance.found - 1));
}

}  // namespace

double net_share(const MonitorPerformance& performance) {
    const double chance = std::isnan(performance.share_by_chance) ? performance.share_at_stated_rate
                                                                  : performance.share_by_chance;
    return performance.share - chance;
}

std::string why_unranked(const MonitorPerformance& performance, double per_1000_h) {
    if (std::isnan(performance.threshold.value)) {
        return "no threshold";
    }
    if (performance.ended == 0) {
        return "no tooth fails";
    }
    if (performance.false_alarms.bounds.lower > per_1000_h) {
        return "more false alarms than stated";
    }
    if (!(chance_of(performance) <= kChanceLevel)) {
        return "no significantly larger share found than by chance";
    }
    return "";
}

bool ranks_before(const MonitorPerformance& a, const MonitorPerformance& b) {
    const auto key = [](const MonitorPerformance& one) {
        return std::tuple(or_last(-net_share(one)), or_last(one.size_90.value),
                          or_last(one.size_50.value), or_last(one.false_alarms.per_1000_h));
    };
    return key(a) < key(b);
}

}  // namespace gearpod::analysis
