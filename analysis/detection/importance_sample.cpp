#include "analysis/detection/importance_sample.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/statistics/distributions.hpp"

namespace gearpod::analysis {
namespace {

// Range of the rates of a gearbox for which its normal score is used.
constexpr double kRarest = 1e-12, kMostFrequent = 0.999;

// Normal scores of the gearboxes' own rates, the most alarming first.
std::vector<double> scores_of(const std::vector<double>& rates) {
    std::vector<double> scores;
    for (const double rate : rates) {
        scores.push_back(normal_upper_quantile(std::clamp(rate, kRarest, kMostFrequent)));
    }
    std::sort(scores.begin(), scores.end());
    return scores;
}

// Variance of the scores on the alarm side of the median, relative to its sum with the noise
// variance of 1.
double share_towards_alarms(const std::vector<double>& scores) {
    const std::size_t half = scores.size() / 2;
    double squares = 0.0;
    for (std::size_t i = 0; i < half; ++i) {
        squares += (scores[half] - scores[i]) * (scores[half] - scores[i]);
    }
    const double variance = squares / static_cast<double>(std::max<std::size_t>(1, half));
    return variance / (1.0 + variance);
}

// Mean excess of the most alarming tenth of the scores over its limit.
double last_excess(const std::vector<double>& scores) {
    constexpr std::size_t kLeast = 5;
    const std::size_t last = std::min(scores.size() - 1, std::max(kLeast, scores.size() / 10));
    double excess = 0.0;
    for (std::size_t i = 0; i < last; ++i) {
        excess += (scores[last] - scores[i]) / static_cast<double>(last);
    }
    return excess;
}

// Rate contributed by gearboxes rarer than one in the sample, if the exponential tail fitted to the
// last tenth of the scores continues beyond the most alarming one.
double missing_rate(const std::vector<double>& scores) {
    constexpr int kSteps = 400;
    const double excess = last_excess(scores);
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
        sum += normal_upper_tail(scores[0] + excess * std::log((i + 0.5) / kSteps));
    }
    return sum / kSteps / static_cast<double>(scores.size());
}

// Similarity of the last tenth to an exponential tail, from its mean excess relative to the
// scatter: 1 for exponential, 0 for normal, whose scores end sooner.
double exponential_share(const std::vector<double>& scores, double share) {
    constexpr double kNormal = 0.4735, kExponential = 0.7071;
    const double scatter = std::sqrt(share / std::max(1e-12, 1.0 - share));
    return scatter > 0.0
               ? std::clamp((last_excess(scores) / scatter - kNormal) / (kExponential - kNormal),
                            0.0, 1.0)
               : 0.0;
}

}  // namespace

ImportanceSample::ImportanceSample(std::span<const double> values, std::span<const double> weights,
                                   std::span<const std::size_t> gearbox, Alarm alarm)
    : sign_(alarm_sign(alarm)) {
    for (std::size_t first = 0; first < values.size();) {
        std::size_t end = first;
        long finite = 0;
        for (; end < values.size() && gearbox[end] == gearbox[first]; ++end) {
            finite += std::isfinite(values[end]) ? 1 : 0;
        }
        for (std::size_t i = first; finite > 0 && i < end; ++i) {
            if (std::isfinite(values[i])) {
                descending_.push_back({sign_ * values[i],
                                       weights[i] / static_cast<double>(end - first),
                                       static_cast<std::size_t>(gearboxes_)});
            }
        }
        records_ += finite;
        gearboxes_ += finite > 0 ? 1 : 0;
        first = end;
    }
    std::stable_sort(descending_.begin(), descending_.end(),
                     [](const Record& a, const Record& b) { return a.value > b.value; });
    double sum = 0.0;
    cumulative_.push_back(0.0);
    for (const Record& record : descending_) {
        sum += record.share / static_cast<double>(gearboxes_);
        cumulative_.push_back(sum);
    }
}

std::size_t ImportanceSample::count_beyond(double rate) const {
    auto count = static_cast<std::size_t>(
        std::upper_bound(cumulative_.begin(), cumulative_.end(), rate) - cumulative_.begin() - 1);
    // Records equal to the threshold do not alarm.
    while (count > 0 && count < descending_.size() &&
           descending_[count - 1].value == descending_[count].value) {
        --count;
    }
    return count;
}

std::vector<double> ImportanceSample::own_rates(std::size_t beyond) const {
    std::vector<double> rates(static_cast<std::size_t>(gearboxes_), 0.0);
    for (std::size_t i = 0; i < beyond; ++i) {
        rates[descending_[i].gearbox] += descending_[i].share;
    }
    return rates;
}

std::optional<ImportanceSample::Estimate> ImportanceSample::threshold(double rate,
                                                                      double confidence) const {
    const std::size_t count = count_beyond(rate);
    if (count == descending_.size()) {
        return std::nullopt;
    }
    auto found = estimate(count, rate, confidence);
    if (found) {
        found->threshold = sign_ * descending_[count].value;
    }
    return found;
}

std::optional<ImportanceSample::Estimate> ImportanceSample::at(double threshold,
                                                               double confidence) const {
    const auto end = std::partition_point(
        descending_.begin(), descending_.end(),
        [value = sign_ * threshold](const Record& record) { return record.value > value; });
    const auto count = static_cast<std::size_t>(end - descending_.begin());
    // Weights have the mean 1; for frequent values their sum may exceed it.
    auto found = estimate(count, std::min(1.0, cumulative_[count]), confidence);
    if (found) {
        found->threshold = threshold;
    }
    return found;
}

std::optional<ImportanceSample::Estimate> ImportanceSample::estimate(std::size_t count, double rate,
                                                                     double confidence) const {
    if (count == 0 || gearboxes_ < 2) {
        return std::nullopt;
    }
    const auto all = static_cast<double>(gearboxes_);
    const std::vector<double> rates = own_rates(count);
    double sum = 0.0, squares = 0.0;
    for (const double of_gearbox : rates) {
        sum += of_gearbox;
        squares += of_gearbox * of_gearbox;
    }
    const std::vector<double> scores = scores_of(rates);
    const double share = share_towards_alarms(scores);
    const double model = all * rate * rate / both_exceed(rate, share);
    const double missing = missing_rate(scores);
    Estimate found;
    found.contributing = std::min(sum * sum / squares, model);
    if (!(found.contributing >= kLeastContributing) || missing > kMostUnseen * rate) {
        return std::nullopt;
    }
    const double mean = sum / all;
    const double seen = (squares / all - mean * mean) / (mean * mean * (all - 1.0));
    const double variance = std::max({seen, 1.0 / model - 1.0 / all, 1e-12});
    found.variance = variance;
    const double tail = 0.5 * (1.0 - confidence);
    const double narrower =
        normal_quantile(1.0 - tail) / student_quantile(found.contributing - 1.0, 1.0 - tail);
    const double alarms = narrower * narrower / variance;
    const double upper = rate / alarms * gamma_upper_quantile(alarms + 1.0, 1.0, tail) +
                         exponential_share(scores, share) * missing;
    found.rate = {std::min(1.0, rate / alarms * gamma_quantile(alarms, 1.0, tail)),
                  std::min(1.0, upper)};
    found.expected = rate;
    found.alarms = static_cast<long>(count);
    return found;
}

Interval ImportanceSample::threshold_interval(double rate, const Estimate& estimate) const {
    // The true rate of a value is its estimated rate times the ratio of the interval's bound to the
    // rate.
    const auto value = [&](double bound) {
        const double target = rate * rate / bound;
        const std::size_t count = std::min(count_beyond(target), descending_.size() - 1);
        return sign_ * descending_[count].value;
    };
    const Interval values{value(estimate.rate.lower), value(estimate.rate.upper)};
    return sign_ > 0.0 ? values : Interval{values.upper, values.lower};
}

}  // namespace gearpod::analysis
