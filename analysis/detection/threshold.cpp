#include "analysis/detection/threshold.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "analysis/statistics/distributions.hpp"
#include "analysis/statistics/interval.hpp"
#include "analysis/statistics/quiet_policy.hpp"
#include "machine/contracts.hpp"

namespace gearpod::analysis {
namespace {

constexpr double kTailRounding = 1e-9;
constexpr long kTailDivisor = 10;  // a tenth of the sample
// Initial search range of the posterior, in units of the median excess: a shape of 2 has a scale of
// 2/3 there, a shape of -1/2 one of 1.7.
constexpr double kLargestShapeOverScale = 3.0, kLogScales = 2.0;
constexpr int kTailNodes = 81;
constexpr double kNodeRange = 6.0;  // standard deviations of the posterior covered by the nodes

// Survival function at x, with shape = shape_over_scale * scale.
double survival_function(double shape_over_scale, double scale, double x) {
    const double argument = shape_over_scale * x;
    if (argument <= -1.0) {
        return 0.0;
    }
    constexpr double kExponentialLimit = 1e-9;  // exponential to rounding
    return std::abs(argument) < kExponentialLimit
               ? std::exp(-x / scale)
               : std::exp(-std::log1p(argument) / (shape_over_scale * scale));
}

struct Moments {
    double mean = 0.0, deviation = 0.0;
};

template <typename Nodes, typename Of>
Moments moments(const Nodes& nodes, Of of) {
    Moments m;
    for (const auto& node : nodes) {
        m.mean += node.weight * of(node);
    }
    for (const auto& node : nodes) {
        m.deviation += node.weight * (of(node) - m.mean) * (of(node) - m.mean);
    }
    m.deviation = std::sqrt(m.deviation);
    return m;
}

struct Weighted {
    double value, weight;
};

// Value at which the cumulative weight, with half of each value's own weight, passes a share of the
// total.
double quantile(const std::vector<Weighted>& ascending, double share) {
    double sum = 0.0, before = 0.0, last = ascending.front().value;
    for (const Weighted& member : ascending) {
        const double here = sum + 0.5 * member.weight;
        if (here >= share) {
            const double part = here > before ? (share - before) / (here - before) : 1.0;
            return last + std::clamp(part, 0.0, 1.0) * (member.value - last);
        }
        sum += member.weight;
        before = here;
        last = member.value;
    }
    return ascending.back().value;
}

Interval middle_of(std::vector<Weighted>& values, double weight, double confidence) {
    std::sort(values.begin(), values.end(),
              [](const Weighted& a, const Weighted& b) { return a.value < b.value; });
    const double tail = 0.5 * (1.0 - confidence);
    return {quantile(values, tail * weight), quantile(values, (1.0 - tail) * weight)};
}

}  // namespace

long exceedances_of(long sample) {
    return std::min(kMostExceedances, sample / kTailDivisor);
}

bool tail_reaches(long sample, double false_alarm_rate) {
    return exceedances_of(sample) >= kLeastExceedances &&
           static_cast<double>(sample) * false_alarm_rate * kFarthestExtrapolation >=
               1.0 - kTailRounding;
}

long sample_for_tail(double false_alarm_rate) {
    return std::max(kTailDivisor * kLeastExceedances,
                    static_cast<long>(std::ceil(1.0 / (kFarthestExtrapolation * false_alarm_rate) -
                                                kTailRounding)));
}

TailFit::TailFit(std::span<const double> largest, long sample)
    : sample_(sample),
      exceedances_(static_cast<long>(largest.size()) - 1),
      above_(largest.front()) {
    EXPECTS(largest.size() >= 2 && std::ranges::is_sorted(largest));
    std::vector<double> excess;
    for (const double value : largest.subspan(1)) {
        excess.push_back(value - above_);
    }
    unit_ = excess[excess.size() / 2];
    if (!(unit_ > 0.0) || !std::isfinite(excess.back())) {
        refusal_ = "the largest healthy values are equal";
        return;
    }
    for (double& value : excess) {
        value /= unit_;
    }
    // The distribution must extend beyond the largest value: 1 + shape_over_scale * largest > 0.
    const double least = -1.0 / *std::max_element(excess.begin(), excess.end());
    nodes_ = posterior(excess, least, kLargestShapeOverScale, -kLogScales, kLogScales);
    const Moments shape_over_scale =
        moments(nodes_, [](const Node& node) { return node.shape_over_scale; });
    const Moments scale = moments(nodes_, [](const Node& node) { return std::log(node.scale); });
    nodes_ = posterior(
        excess, std::max(least, shape_over_scale.mean - kNodeRange * shape_over_scale.deviation),
        shape_over_scale.mean + kNodeRange * shape_over_scale.deviation,
        scale.mean - kNodeRange * scale.deviation, scale.mean + kNodeRange * scale.deviation);
    shape_ =
        moments(nodes_, [](const Node& node) { return node.shape_over_scale * node.scale; }).mean;
    scale_ = unit_ * moments(nodes_, [](const Node& node) { return node.scale; }).mean;
}

// In shape_over_scale and log scale, the sum over the excesses depends on shape_over_scale alone.
// The prior is then scale / ((1 + shape) sqrt(1 + 2 shape)).
std::vector<TailFit::Node> TailFit::posterior(const std::vector<double>& excess,
                                              double shape_over_scale_low,
                                              double shape_over_scale_high, double log_scale_low,
                                              double log_scale_high) const {
    const auto k = static_cast<double>(excess.size());
    const double total = std::accumulate(excess.begin(), excess.end(), 0.0);
    std::vector<Node> nodes;
    std::vector<double> logs;
    double most = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < kTailNodes; ++i) {
        // Midpoints, because the likelihood is 0 at the smallest shape_over_scale.
        const double shape_over_scale =
            shape_over_scale_low +
            (i + 0.5) / kTailNodes * (shape_over_scale_high - shape_over_scale_low);
        double sum = 0.0;
        for (const double y : excess) {
            sum += std::log1p(shape_over_scale * y);
        }
        const double slope =
            std::abs(shape_over_scale) < kTailRounding ? total : sum / shape_over_scale;
        for (int j = 0; j < kTailNodes; ++j) {
            const double s =
                log_scale_low + (j + 0.5) / kTailNodes * (log_scale_high - log_scale_low);
            const double scale = std::exp(s), shape = shape_over_scale * scale;
            if (shape <= -0.5) {
                continue;
            }
            logs.push_back(-k * s - sum - slope / scale + s - std::log1p(shape) -
                           0.5 * std::log1p(2.0 * shape));
            nodes.push_back({shape_over_scale, scale, 0.0});
            most = std::max(most, logs.back());
        }
    }
    double weight = 0.0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        weight += nodes[i].weight = std::exp(logs[i] - most);
    }
    constexpr double kNegligibleWeight = 1e-12;
    std::erase_if(nodes,
                  [&](const Node& node) { return node.weight < kNegligibleWeight * weight; });
    for (Node& node : nodes) {
        node.weight /= weight;
    }
    return nodes;
}

double TailFit::rate(double value) const {
    const double x = (value - above_) / unit_;
    double sum = 0.0;
    for (const Node& node : nodes_) {
        sum += node.weight * survival_function(node.shape_over_scale, node.scale, x);
    }
    return sum * static_cast<double>(exceedances_ + 1) / static_cast<double>(sample_ + 1);
}

std::vector<double> TailFit::shares() const {
    constexpr int kShares = 9;  // few are enough: it varies little compared with the fit
    const auto above = static_cast<double>(exceedances_ + 1);
    const auto below = static_cast<double>(sample_ - exceedances_);
    std::vector<double> shares;
    for (int i = 0; i < kShares; ++i) {
        shares.push_back(beta_quantile(above, below, (i + 0.5) / kShares));
    }
    return shares;
}

HealthyRate TailFit::rate(double value, long alarms, long tested, double confidence) const {
    const std::vector<double> shares = this->shares();
    const auto hits = static_cast<double>(alarms), misses = static_cast<double>(tested - alarms);
    // Likelihood relative to its maximum, at the count's own rate.
    const double observed = tested > 0 ? hits / static_cast<double>(tested) : 0.0;
    const auto likelihood = [&](double p) {
        const double of_hits = hits > 0.0 ? hits * std::log(p / observed) : 0.0;
        const double of_misses =
            misses > 0.0 ? misses * std::log1p((observed - p) / (1.0 - observed)) : 0.0;
        return std::exp(of_hits + of_misses);
    };
    const double x = (value - above_) / unit_;
    std::vector<Weighted> rates;
    double weight = 0.0, mean = 0.0;
    for (const Node& node : nodes_) {
        const double beyond = survival_function(node.shape_over_scale, node.scale, x);
        for (const double share : shares) {
            const double p = share * beyond;
            rates.push_back({p, node.weight * likelihood(p)});
            weight += rates.back().weight;
            mean += rates.back().weight * p;
        }
    }
    if (!(weight > 0.0)) {  // the count contradicts the distribution
        return {kNan, {kNan, kNan}};
    }
    return {mean / weight, middle_of(rates, weight, confidence)};
}

Interval TailFit::threshold_interval(double rate, double confidence) const {
    std::vector<Weighted> values;
    double weight = 0.0;
    for (const double share : shares()) {
        const double log_ratio = std::log(std::min(1.0, rate / share));
        for (const Node& node : nodes_) {
            const double shape = node.shape_over_scale * node.scale;
            const double x = std::abs(shape) < kTailRounding
                                 ? -node.scale * log_ratio
                                 : std::expm1(-shape * log_ratio) / node.shape_over_scale;
            values.push_back({above_ + unit_ * x, node.weight});
            weight += node.weight;
        }
    }
    return middle_of(values, weight, confidence);
}

double TailFit::threshold(double rate) const {
    const auto log_rate_ratio = [&](double x) {
        constexpr double kTinyRate = 1e-300;  // beyond the end of every distribution
        return std::log(std::max(kTinyRate, this->rate(above_ + unit_ * x) / rate));
    };
    if (log_rate_ratio(0.0) <= 0.0) {
        return above_;
    }
    double high = 1.0;
    while (log_rate_ratio(high) > 0.0) {
        high *= 2.0;
    }
    std::uintmax_t steps = 100;
    const auto bracket = boost::math::tools::toms748_solve(
        log_rate_ratio, 0.5 * (high > 1.0 ? high : 0.0), high,
        boost::math::tools::eps_tolerance<double>(40), steps, QuietPolicy());
    // The end of the bracket that does not exceed the rate.
    return above_ + unit_ * bracket.second;
}

HealthyRate rate_of(const Threshold& threshold, Alarm alarm, double false_alarm_rate, long alarms,
                    long tested, double confidence) {
    if (threshold.importance_sampled) {
        return {false_alarm_rate, threshold.importance_sampled->rate};
    }
    return threshold.tail
               ? threshold.tail->rate(alarm_sign(alarm) * threshold.value, alarms, tested,
                                      confidence)
               : healthy_rate(threshold.sample, false_alarm_rate, alarms, tested, confidence);
}

namespace {

// Smallest rank of a healthy value for which, with the confidence 1 - tail, fewer than `rate` of
// all gearboxes lie beyond that value. With `below`, the largest rank for which more than `rate`
// do. n + 1 or 0 if there is none.
long rank_within(long sample, double rate, double tail, bool below) {
    long low = 0, high = sample + 1;
    while (high - low > 1) {
        const long middle = low + (high - low) / 2;
        // Probability that at most `rate` of all gearboxes lie beyond the value of rank `middle`.
        // It increases with the rank.
        const double p =
            beta_cdf(static_cast<double>(sample + 1 - middle), static_cast<double>(middle), rate);
        ((below ? p <= tail : p < 1.0 - tail) ? low : high) = middle;
    }
    return below ? low : high;
}

}  // namespace

Threshold alarm_threshold(std::vector<double> healthy, Alarm alarm, double false_alarm_rate) {
    return SortedSample(std::move(healthy), alarm).threshold(false_alarm_rate);
}

SortedSample::SortedSample(std::vector<double> healthy, Alarm alarm)
    : alarm_(alarm), ascending_(std::move(healthy)) {
    std::erase_if(ascending_, [](double value) { return !std::isfinite(value); });
    for (double& value : ascending_) {
        value *= alarm_sign(alarm);
    }
    std::sort(ascending_.begin(), ascending_.end());
}

std::span<const double> SortedSample::largest(long exceedances) const {
    const auto kept = static_cast<std::size_t>(std::min(size(), exceedances + 1));
    return std::span(ascending_).last(kept);
}

const TailFit& SortedSample::tail() const {
    if (!tail_) {
        tail_.emplace(largest(exceedances_of(size())), size());
    }
    return *tail_;
}

Threshold SortedSample::threshold(double false_alarm_rate) const {
    Threshold threshold;
    threshold.sample = size();
    threshold.value = kNan;
    const long rank = threshold_rank(size(), false_alarm_rate);
    if (rank <= size()) {
        threshold.value = alarm_sign(alarm_) * ascending_[static_cast<std::size_t>(rank - 1)];
    } else if (tail_reaches(size(), false_alarm_rate) && tail().refusal().empty()) {
        threshold.value = alarm_sign(alarm_) * tail().threshold(false_alarm_rate);
        threshold.tail = tail();
    }
    threshold.alarms = std::count_if(ascending_.begin(), ascending_.end(), [&](double value) {
        return is_alarm(alarm_sign(alarm_) * value, threshold.value, alarm_);
    });
    return threshold;
}

Interval SortedSample::value_bounds(double false_alarm_rate, double confidence) const {
    constexpr double kOpen = std::numeric_limits<double>::infinity();
    const double tail_share = 0.5 * (1.0 - confidence);
    const long low = rank_within(size(), false_alarm_rate, tail_share, true),
               high = rank_within(size(), false_alarm_rate, tail_share, false);
    Interval values{low < 1 ? -kOpen : ascending_[static_cast<std::size_t>(low - 1)],
                    high > size() ? kOpen : ascending_[static_cast<std::size_t>(high - 1)]};
    if (high > size() && tail_reaches(size(), false_alarm_rate) && tail().refusal().empty()) {
        values = tail().threshold_interval(false_alarm_rate, confidence);
    }
    return alarm_ == Alarm::high ? values : Interval{-values.upper, -values.lower};
}

}  // namespace gearpod::analysis
