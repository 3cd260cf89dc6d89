// Alarm threshold at a stated false-alarm rate: an order statistic of a healthy sample, or a
// quantile of its fitted tail.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/detection/detection_table.hpp"
#include "analysis/detection/importance_sample.hpp"
#include "analysis/statistics/interval.hpp"

namespace gearpod::analysis {

// False-alarm rate of a threshold set by a healthy sample, whatever the feature's distribution.
// With a threshold at the r-th smallest of n continuous values, the probability beyond it is Beta(n
// + 1 - r, r) distributed: S. S. Wilks, Ann. Math. Stat. 12 (1941), 91-96; H. A. David, H. N.
// Nagaraja, Order Statistics (2003), section 2.1. Ties only lower the rate.

// Rank r used by SortedSample::threshold(), 1 <= r <= n; n + 1 if the sample is too small.
long threshold_rank(long sample, double false_alarm_rate);

// Two-sided tolerance interval of the rate of one given threshold. NaN if there is no threshold.
Interval threshold_rate_interval(long sample, double false_alarm_rate, double confidence);

// Smallest healthy sample that has a threshold at the rate.
long sample_for_threshold(double false_alarm_rate);

// Smallest healthy sample for which, and for all larger ones, the upper bound of
// threshold_rate_interval() is at most twice the requested rate. A sample of this size counts as
// large enough.
long sample_for_rate(double false_alarm_rate, double confidence);

// Rate of a threshold after `alarms` of `tested` further healthy gearboxes: the Beta distribution
// above, updated by the binomial count. Mean and equal-tailed bounds are exact over repeated
// studies, because the Beta distribution is the true distribution of thresholds, not a prior
// opinion.
struct HealthyRate {
    double rate = 0.0;
    Interval bounds;
};
HealthyRate healthy_rate(long sample, double false_alarm_rate, long alarms, long tested,
                         double confidence);

// Interval of the expected rate over repeated studies that each set their own threshold: the rates
// q at which both `alarms` or more and `alarms` or fewer keep a probability of (1 - confidence) /
// 2. The count is beta-binomial, Beta((n + 1) q, (n + 1)(1 - q)), which includes the scatter of the
// threshold. NaN if tested or sample is 0.
Interval expected_rate_interval(long sample, long alarms, long tested, double confidence);

// Alarm thresholds beyond a healthy sample by peaks over threshold. Values above a high order
// statistic approximately follow a generalised Pareto distribution, whatever the feature's
// distribution: J. Pickands, Ann. Stat. 3 (1975), 119-131; A. C. Davison, R. L. Smith, J. R. Stat.
// Soc. B 52 (1990), 393-442.
//
// Shape and scale have their posterior under Jeffreys' prior, 1 / (scale (1 + shape) sqrt(1 + 2
// shape)), shape > -1/2: M. E. Castellanos, S. Cabras, J. Stat. Plan. Inference 137 (2007),
// 473-483. The share above the order statistic is Beta(k + 1, n - k) distributed with k of n values
// above (healthy_rate). If the distribution holds, the *expected* rate of a threshold is
// the requested one, as with an order statistic, and the interval is that of the given threshold.
// Both are integrals over a grid, without random numbers.

// Limits of the fit. The distribution is fitted to the largest tenth of a sample, at most
// kMostExceedances values; more would add bias faster than they reduce variance. Fewer than
// kLeastExceedances do not determine the shape. Extrapolation is limited to rates
// kFarthestExtrapolation times rarer than one in the sample. Within these limits, intervals keep
// their nominal coverage (tests/analysis/detection/test_tail.cpp).
inline constexpr long kMostExceedances = 200;
inline constexpr long kLeastExceedances = 100;
inline constexpr double kFarthestExtrapolation = 5.0;

long exceedances_of(long sample);
bool tail_reaches(long sample, double false_alarm_rate);
// Smallest sample whose tail reaches the rate.
long sample_for_tail(double false_alarm_rate);

class TailFit {
  public:
    // Fits the tail. `largest`: an order statistic followed by the values that exceed it,
    // ascending, out of `sample` finite values.
    TailFit(std::span<const double> largest, long sample);

    // Reason why there is no fit (equal healthy values), or "".
    const std::string& refusal() const { return refusal_; }
    long exceedances() const { return exceedances_; }
    double above() const { return above_; }  // the order statistic
    double shape() const { return shape_; }  // posterior means
    double scale() const { return scale_; }

    // Rate beyond a value at or above the order statistic: its expected rate, and its rate and
    // interval updated by `alarms` of `tested` further healthy gearboxes. NaN if that count
    // contradicts the fit.
    double rate(double value) const;
    HealthyRate rate(double value, long alarms, long tested, double confidence) const;
    // Value whose expected rate is `rate`; the order statistic for a rate above its own.
    double threshold(double rate) const;
    // Interval of the value whose rate is exactly `rate`.
    Interval threshold_interval(double rate, double confidence) const;

  private:
    struct Node {
        double shape_over_scale, scale, weight;  // in units of the median excess
    };
    std::vector<Node> posterior(const std::vector<double>& excess, double shape_over_scale_low,
                                double shape_over_scale_high, double log_scale_low,
                                double log_scale_high) const;
    // Equally likely values of the share above the order statistic.
    std::vector<double> shares() const;

    long sample_ = 0, exceedances_ = 0;
    double above_ = 0.0, unit_ = 1.0, shape_ = kNan, scale_ = kNan;
    std::vector<Node> nodes_;  // weights sum to 1
    std::string refusal_;
};

// Alarm threshold from a healthy sample at a stated false-alarm rate.
struct Threshold {
    double value = 0.0;  // NaN if the sample is too small for the rate
    long sample = 0;     // number of finite healthy values
    long alarms = 0;     // number of them beyond the threshold
    // Tail fit of an extrapolated threshold, with values negated for a low alarm.
    std::optional<TailFit> tail;
    // Estimate of an importance-sampled threshold, and its number of gearboxes.
    std::optional<ImportanceSample::Estimate> importance_sampled = {};
    long gearboxes = 0;
};

// Thresholds from one healthy sample, which is sorted and whose tail is fitted once. An object
// belongs to one thread.
class SortedSample {
  public:
    // Values that are not finite are left out.
    SortedSample(std::vector<double> healthy, Alarm alarm);

    // The ceil((n+1)(1-rate))-th smallest of n values (largest for a low alarm). A further healthy
    // gearbox from the same population lies strictly beyond the r-th smallest of n with an expected
    // probability of (n+1-r)/(n+1), whatever the distribution. This is therefore the tightest order
    // statistic that keeps the rate. Where it would need more than n values, the threshold is
    // extrapolated as far as the tail permits.
    Threshold threshold(double false_alarm_rate) const;
    // Interval of the value that is exceeded with exactly the requested rate, from order statistics
    // or from the tail. A bound is infinite where neither reaches.
    Interval value_bounds(double false_alarm_rate, double confidence) const;

    // Finite values, negated for a low alarm.
    const std::vector<double>& ascending() const { return ascending_; }
    // The `exceedances` largest of these and the one before them; all if there are no more.
    std::span<const double> largest(long exceedances) const;

  private:
    long size() const { return static_cast<long>(ascending_.size()); }
    const TailFit& tail() const;

    Alarm alarm_;
    std::vector<double> ascending_;
    mutable std::optional<TailFit> tail_;  // fitted when first needed
};

// False-alarm rate of this threshold from its own sample and `alarms` of `tested` further healthy
// gearboxes; from the sample alone for an importance-sampled threshold. NaN without a threshold.
HealthyRate rate_of(const Threshold& threshold, Alarm alarm, double false_alarm_rate, long alarms,
                    long tested, double confidence);

// Alarm thresholds and false-alarm rates from healthy records, also from several records of each
// gearbox or from importance sampling.

// False-alarm rate of a two-level healthy sample: several recordings of each of fewer gearboxes.
// Recordings of one gearbox are correlated, so they determine a false-alarm rate less well than as
// many gearboxes do. Treated as independent, 95 % intervals may cover the rate of fewer than half
// of the thresholds.

// Counterpart of threshold_rate_interval() for values grouped by gearbox. Three cases:
//
// - At least five expected alarming gearboxes (gearboxes x rate): effective sample size, the number
//   of recordings divided by the ratio of the scatter of alarms between gearboxes to the binomial
//   one (L. Kish, Survey Sampling (1965), section 8.2), reduced for few gearboxes by Student's t
//   (E. L. Korn, B. I. Graubard, Survey Methodology 24 (1998), 193-201).
// - Rarer alarms: the scatter follows from the gearboxes' share of the variance, as if gearbox and
//   remainder had normal scores. This needs enough gearboxes with alarms (rare_interval()) and
//   observed scatter that does not contradict it.
// - Otherwise each gearbox counts as one recording.
Interval clustered_rate_interval(std::span<const double> values,
                                 std::span<const std::size_t> gearbox, Alarm alarm,
                                 double threshold, double false_alarm_rate, double confidence);

// Values of a healthy sample. Without `gearbox`, each value belongs to a gearbox of its own.
struct HealthyValues {
    std::span<const double> values;
    // Importance-sampled records of one gearbox are consecutive.
    std::span<const std::size_t> gearbox = {};
    std::span<const double> weights = {};  // of importance-sampled records (importance_sample.hpp)

    bool clustered() const;
};

// Threshold estimator. The method depends on the sample:
//
// - Plain values: SortedSample::threshold().
// - Several plain records per gearbox: the same order statistics, without extrapolation, because
//   the tail of clustered values is not known.
// - Importance-sampled records: importance_sample.hpp. Where too few gearboxes contribute,
//   SortedSample::threshold() of the first record of each gearbox, which is plain.
class HealthyThresholds {
  public:
    HealthyThresholds(const HealthyValues& sample, Alarm alarm);

    Threshold at(double false_alarm_rate, double confidence) const;
    // Interval of the value whose rate is exactly the requested one; `threshold` is the result of
    // at().
    Interval value_bounds(const Threshold& threshold, double false_alarm_rate,
                          double confidence) const;
    Interval rate_bounds(const Threshold& threshold, double false_alarm_rate,
                         double confidence) const;

    // Values that order statistics are taken from: all plain values, or the first record of each
    // gearbox.
    const std::vector<double>& plain() const { return plain_; }
    const SortedSample& sorted() const { return sorted_; }

  private:
    Alarm alarm_;
    std::vector<double> plain_;
    SortedSample sorted_;               // the plain values
    std::vector<std::size_t> gearbox_;  // gearboxes of the plain values, if several share one
    std::optional<ImportanceSample> importance_sample_;
};

}  // namespace gearpod::analysis
