#include "analysis/detection/threshold.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "analysis/statistics/distributions.hpp"
#include "analysis/statistics/quiet_policy.hpp"
#include "analysis/statistics/rank_statistics.hpp"
#include "machine/contracts.hpp"

namespace gearpod::analysis {
namespace {

// (n+1)(1-rate) is a whole number for the usual rates; this keeps rounding from adding one to it.
constexpr double kRounding = 1e-9;

Interval equal_tails(double a, double b, double confidence) {
    const double tail = 0.5 * (1.0 - confidence);
    return {beta_quantile(a, b, tail), beta_upper_quantile(a, b, tail)};
}

// P(count <= k) of the beta-binomial distribution, summed on k's side of the mean, where terms
// decrease outwards.
double beta_binomial_cdf(long k, long tested, double a, double b) {
    const auto m = static_cast<double>(tested);
    const bool below = static_cast<double>(k) < m * a / (a + b);
    if (k >= tested) {
        return 1.0;
    }
    auto i = static_cast<double>(below ? k : k + 1);
    double p = std::exp(log_gamma(m + 1.0) - log_gamma(i + 1.0) - log_gamma(m - i + 1.0) +
                        log_gamma(i + a) + log_gamma(m - i + b) - log_gamma(m + a + b) +
                        log_gamma(a + b) - log_gamma(a) - log_gamma(b));
    constexpr double kNoMore = 1e-18;
    double sum = 0.0;
    while (i >= 0.0 && i <= m && p > kNoMore * sum) {
        sum += p;
        p *= below ? i * (m - i + b) / ((m - i + 1.0) * (i - 1.0 + a))
                   : (m - i) * (i + a) / ((i + 1.0) * (m - i - 1.0 + b));
        i += below ? -1.0 : 1.0;
    }
    sum = std::min(sum, 1.0);
    return below ? sum : 1.0 - sum;
}

template <typename Tail>
double solve_rate(Tail tail, double target) {
    const auto miss = [&](double q) { return tail(q) - target; };
    double low = 1e-12, high = 1.0 - 1e-12;
    if (miss(low) * miss(high) > 0.0) {
        return std::abs(miss(low)) < std::abs(miss(high)) ? 0.0 : 1.0;
    }
    std::uintmax_t steps = 200;
    const auto bracket = boost::math::tools::toms748_solve(
        miss, low, high, boost::math::tools::eps_tolerance<double>(40), steps, QuietPolicy());
    return 0.5 * (bracket.first + bracket.second);
}

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

long threshold_rank(long sample, double false_alarm_rate) {
    const double exact = static_cast<double>(sample + 1) * (1.0 - false_alarm_rate);
    return std::max(1L, static_cast<long>(std::ceil(exact - kRounding)));
}

Interval threshold_rate_interval(long sample, double false_alarm_rate, double confidence) {
    const long rank = threshold_rank(sample, false_alarm_rate);
    if (rank > sample) {
        return {kNan, kNan};
    }
    return equal_tails(static_cast<double>(sample + 1 - rank), static_cast<double>(rank),
                       confidence);
}

long sample_for_threshold(double false_alarm_rate) {
    return static_cast<long>(std::ceil(1.0 / false_alarm_rate - 1.0 - kRounding));
}

long sample_for_rate(double false_alarm_rate, double confidence) {
    const auto enough = [&](long sample) {
        return threshold_rate_interval(sample, false_alarm_rate, confidence).upper <=
               2.0 * false_alarm_rate;
    };
    // With k values beyond the threshold the bound falls with the sample, and it jumps where k
    // grows. The smallest sample of every k is therefore its worst.
    const auto smallest = [&](long beyond) {
        return static_cast<long>(
            std::ceil(static_cast<double>(beyond) / false_alarm_rate - 1.0 - kRounding));
    };
    const auto first = [](long low, long high, auto holds) {
        while (high - low > 1) {
            const long middle = low + (high - low) / 2;
            (holds(middle) ? high : low) = middle;
        }
        return high;
    };
    long most = 1;
    while (!enough(smallest(most))) {
        most *= 2;
    }
    const long beyond = first(0, most, [&](long k) { return enough(smallest(k)); });
    return first(smallest(beyond - 1), smallest(beyond), enough);
}

HealthyRate healthy_rate(long sample, double false_alarm_rate, long alarms, long tested,
                         double confidence) {
    const long rank = threshold_rank(sample, false_alarm_rate);
    if (rank > sample) {
        return {kNan, {kNan, kNan}};
    }
    const auto a = static_cast<double>(sample + 1 - rank + alarms);
    const auto b = static_cast<double>(rank + tested - alarms);
    return {a / (a + b), equal_tails(a, b, confidence)};
}

Interval expected_rate_interval(long sample, long alarms, long tested, double confidence) {
    if (sample <= 0 || tested <= 0) {
        return {kNan, kNan};
    }
    const double tail = 0.5 * (1.0 - confidence);
    const auto whole = static_cast<double>(sample + 1);
    const auto at_most = [&](long k, double q) {
        return beta_binomial_cdf(k, tested, whole * q, whole * (1.0 - q));
    };
    Interval bounds{0.0, 1.0};
    if (alarms > 0) {
        bounds.lower = solve_rate([&](double q) { return 1.0 - at_most(alarms - 1, q); }, tail);
    }
    if (alarms < tested) {
        bounds.upper = solve_rate([&](double q) { return at_most(alarms, q); }, tail);
    }
    return bounds;
}

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

namespace {

struct Gearbox {
    std::vector<double> values;
    double alarms = 0.0;

    double recordings() const { return static_cast<double>(values.size()); }
};
using Gearboxes = std::map<std::size_t, Gearbox>;

struct Totals {
    double gearboxes = 0.0, recordings = 0.0, alarms = 0.0;
};

Totals totals(const Gearboxes& gearboxes) {
    Totals all;
    for (const auto& [number, gearbox] : gearboxes) {
        all.gearboxes += 1.0;
        all.recordings += gearbox.recordings();
        all.alarms += gearbox.alarms;
    }
    return all;
}

// Design effect: variance of the alarms between gearboxes relative to that of as many independent
// recordings.
double design_effect(const Gearboxes& gearboxes) {
    const Totals all = totals(gearboxes);
    const double rate = std::max(0.5, all.alarms) / all.recordings;
    double squares = 0.0;
    for (const auto& [number, gearbox] : gearboxes) {
        const double excess = gearbox.alarms - rate * gearbox.recordings();
        squares += excess * excess;
    }
    const double effect =
        all.gearboxes / (all.gearboxes - 1.0) * squares / (all.recordings * rate * (1.0 - rate));
    return std::clamp(effect, 1.0, all.recordings / all.gearboxes);
}

// Effective number of alarming gearboxes: the number of gearboxes with equal counts that would
// determine the scatter equally well.
double effective_alarming_gearboxes(const Gearboxes& gearboxes) {
    double alarms = 0.0, squares = 0.0;
    for (const auto& [number, gearbox] : gearboxes) {
        alarms += gearbox.alarms;
        squares += gearbox.alarms * gearbox.alarms;
    }
    return squares > 0.0 ? alarms * alarms / squares : 0.0;
}

// Share of the gearboxes in the variance of normal scores, by analysis of variance of the first
// recordings of each (S. R. Searle, G. Casella, C. E. McCulloch, Variance Components (1992),
// section 3.6).
double share_of_gearboxes(const Gearboxes& gearboxes) {
    constexpr std::size_t kMost = 10;
    std::vector<double> values;
    for (const auto& [number, gearbox] : gearboxes) {
        const auto first = gearbox.values.begin();
        values.insert(values.end(), first,
                      first + static_cast<std::ptrdiff_t>(std::min(kMost, gearbox.values.size())));
    }
    const std::vector<double> ranks = midranks(values);
    const auto n = static_cast<double>(values.size()), g = static_cast<double>(gearboxes.size());
    double between = 0.0, within = 0.0, squares = 0.0;
    std::size_t index = 0;
    for (const auto& [number, gearbox] : gearboxes) {
        const std::size_t records = std::min(kMost, gearbox.values.size());
        double sum = 0.0, sum2 = 0.0;
        for (std::size_t i = 0; i < records; ++i, ++index) {
            const double score = -normal_upper_quantile((ranks[index] - 0.5) / n);
            sum += score;
            sum2 += score * score;
        }
        const auto count = static_cast<double>(records);
        between += sum * sum / count;  // the mean of the scores is 0
        within += sum2 - sum * sum / count;
        squares += count * count;
    }
    if (g < 2.0 || n <= g) {
        return 0.0;
    }
    const double each = (n - squares / n) / (g - 1.0);
    const double mean_between = between / (g - 1.0), mean_within = within / (n - g);
    const double variance = std::max(0.0, (mean_between - mean_within) / each);
    return variance > 0.0 ? variance / (variance + mean_within) : 0.0;
}

// Interval from an effective sample size; `scatter_sample`: number of gearboxes that determine the
// scatter.
Interval effective_interval(double recordings, double effect, double scatter_sample, double rate,
                            double tail) {
    const double narrower =
        normal_quantile(1.0 - tail) / student_quantile(scatter_sample - 1.0, 1.0 - tail);
    const double sample = recordings / effect * narrower * narrower + 1.0;
    const double a = sample * rate, b = sample - a;
    return {beta_quantile(a, b, tail), beta_quantile(a, b, 1.0 - tail)};
}

// Interval where alarms are rarer than gearboxes. The scatter between gearboxes is the larger of
// that of normal scores and the observed one. Empty where few gearboxes have the alarms, or where
// they scatter more than normal scores.
std::optional<Interval> rare_interval(const Gearboxes& gearboxes, double rate, double tail) {
    constexpr double kLeastScatterSample = 20.0, kLeastAlarming = 15.0, kAlike = 1.3;
    const Totals all = totals(gearboxes);
    const double others = all.recordings / all.gearboxes - 1.0;
    const double both = both_exceed(rate, share_of_gearboxes(gearboxes));
    const double effect = 1.0 + others * (both - rate * rate) / (rate * (1.0 - rate));
    const double scatter_sample = all.recordings * rate / (1.0 + others * both / rate);
    const double seen = design_effect(gearboxes),
                 alarming_now = effective_alarming_gearboxes(gearboxes);
    if (scatter_sample < kLeastScatterSample || alarming_now < kLeastAlarming ||
        seen > kAlike * effect) {
        return std::nullopt;
    }
    return effective_interval(all.recordings, std::max(seen, effect),
                              std::min(scatter_sample, alarming_now), rate, tail);
}

// All values, or the first of each gearbox of an importance-sampled sample.
std::vector<double> plain_values(const HealthyValues& sample) {
    std::vector<double> plain;
    for (std::size_t i = 0; i < sample.values.size(); ++i) {
        if (sample.weights.empty() || i == 0 || sample.gearbox[i] != sample.gearbox[i - 1]) {
            plain.push_back(sample.values[i]);
        }
    }
    return plain;
}

}  // namespace

Interval clustered_rate_interval(std::span<const double> values,
                                 std::span<const std::size_t> gearbox, Alarm alarm,
                                 double threshold, double false_alarm_rate, double confidence) {
    Gearboxes gearboxes;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (std::isfinite(values[i])) {
            Gearbox& of_row = gearboxes[gearbox[i]];
            of_row.values.push_back(values[i]);
            of_row.alarms += is_alarm(values[i], threshold, alarm) ? 1.0 : 0.0;
        }
    }
    const Totals all = totals(gearboxes);
    const double tail = 0.5 * (1.0 - confidence);
    constexpr double kExpected = 5.0;
    if (all.gearboxes * false_alarm_rate >= kExpected) {
        return effective_interval(all.recordings, design_effect(gearboxes), all.gearboxes,
                                  false_alarm_rate, tail);
    }
    if (const auto rare = rare_interval(gearboxes, false_alarm_rate, tail)) {
        return *rare;
    }
    // Counts all recordings of a gearbox as one: the order statistic is then one of gearboxes. The
    // share beyond it may be below or above the requested rate.
    const double rank = std::ceil(
        static_cast<double>(threshold_rank(std::lround(all.recordings), false_alarm_rate)) /
        all.recordings * all.gearboxes);
    const double a = (all.gearboxes + 1.0) * false_alarm_rate;
    return {beta_quantile(a, all.gearboxes + 1.0 - a, tail),
            beta_quantile(std::max(1.0, all.gearboxes + 1.0 - rank), std::min(rank, all.gearboxes),
                          1.0 - tail)};
}

bool HealthyValues::clustered() const {
    std::vector<std::size_t> sorted(gearbox.begin(), gearbox.end());
    std::sort(sorted.begin(), sorted.end());
    return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
}

HealthyThresholds::HealthyThresholds(const HealthyValues& sample, Alarm alarm)
    : alarm_(alarm), plain_(plain_values(sample)), sorted_(plain_, alarm) {
    if (!sample.weights.empty()) {
        importance_sample_.emplace(sample.values, sample.weights, sample.gearbox, alarm);
    } else if (sample.clustered()) {
        gearbox_.assign(sample.gearbox.begin(), sample.gearbox.end());
    }
}

Threshold HealthyThresholds::at(double false_alarm_rate, double confidence) const {
    if (const auto estimate = importance_sample_
                                  ? importance_sample_->threshold(false_alarm_rate, confidence)
                                  : std::nullopt) {
        Threshold threshold;
        threshold.value = estimate->threshold;
        threshold.sample = importance_sample_->records();
        threshold.alarms = estimate->alarms;
        threshold.gearboxes = importance_sample_->gearboxes();
        threshold.importance_sampled = estimate;
        return threshold;
    }
    Threshold threshold = sorted_.threshold(false_alarm_rate);
    if (!gearbox_.empty() && threshold.tail) {
        threshold.value = kNan;
        threshold.tail.reset();
    }
    return threshold;
}

Interval HealthyThresholds::value_bounds(const Threshold& threshold, double false_alarm_rate,
                                         double confidence) const {
    if (threshold.importance_sampled) {
        return importance_sample_->threshold_interval(false_alarm_rate,
                                                      *threshold.importance_sampled);
    }
    if (gearbox_.empty()) {
        return sorted_.value_bounds(false_alarm_rate, confidence);
    }
    // The true rate of a value is the rate of its rank times the ratio of the interval's bound to
    // the rate.
    const Interval rate = rate_bounds(threshold, false_alarm_rate, confidence);
    const std::vector<double>& ascending = sorted_.ascending();
    const auto value = [&](double bound) {
        const double target = false_alarm_rate * false_alarm_rate / bound;
        const double rank = std::ceil((static_cast<double>(ascending.size()) + 1.0) *
                                      (1.0 - std::min(1.0, target)));
        const double sign = alarm_sign(alarm_);
        return rank > static_cast<double>(ascending.size())
                   ? sign * std::numeric_limits<double>::infinity()
                   : sign * ascending[static_cast<std::size_t>(std::max(1.0, rank)) - 1];
    };
    const Interval values{value(rate.lower), value(rate.upper)};
    return alarm_ == Alarm::high ? values : Interval{values.upper, values.lower};
}

Interval HealthyThresholds::rate_bounds(const Threshold& threshold, double false_alarm_rate,
                                        double confidence) const {
    const Interval independent =
        rate_of(threshold, alarm_, false_alarm_rate, 0, 0, confidence).bounds;
    if (threshold.importance_sampled || gearbox_.empty() || std::isnan(threshold.value)) {
        return independent;
    }
    const Interval clustered = clustered_rate_interval(plain_, gearbox_, alarm_, threshold.value,
                                                       false_alarm_rate, confidence);
    return {std::min(independent.lower, clustered.lower),
            std::max(independent.upper, clustered.upper)};
}

}  // namespace gearpod::analysis
