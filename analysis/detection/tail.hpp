// Alarm thresholds beyond a healthy sample: peaks over threshold. What lies above a high order
// statistic of the sample follows nearly a generalised Pareto law, whatever the feature's
// distribution: J. Pickands, Ann. Stat. 3 (1975), 119-131; A. C. Davison, R. L. Smith,
// J. R. Stat. Soc. B 52 (1990), 393-442.
//
// Shape and scale have their posterior under Jeffreys' prior, 1 / (scale (1 + shape)
// sqrt(1 + 2 shape)), shape > -1/2: M. E. Castellanos, S. Cabras, J. Stat. Plan. Inference 137
// (2007), 473-483. The share above the order statistic has its own law, Beta(k + 1, n - k) with k
// of n values above (false_alarm_rate.hpp). So the *expected* rate of a threshold, the law granted,
// is the one asked for, as with an order statistic, and its interval is that of this very
// threshold. Both are integrals over a grid: no random numbers.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "analysis/detection/false_alarm_rate.hpp"
#include "analysis/statistics/interval.hpp"

namespace gearpod::analysis {

// The law is fitted to the largest tenth of a sample, at most so many, where more would bend it
// faster than they narrow it; fewer than the least leave its shape open. It is trusted for rates so
// many times rarer than one in the sample. Within these, intervals cover what they promise
// (tests/analysis/detection/test_tail.cpp).
inline constexpr long kMostExceedances = 200;
inline constexpr long kLeastExceedances = 100;
inline constexpr double kFarthestExtrapolation = 5.0;

long exceedances_of(long sample);
bool tail_reaches(long sample, double false_alarm_rate);
// The smallest sample whose tail reaches the rate.
long sample_for_tail(double false_alarm_rate);

class TailFit {
  public:
    // `largest`: the values that exceed an order statistic, and that statistic before them,
    // ascending, of `sample` finite values in all.
    TailFit(std::span<const double> largest, long sample);

    // Why there is no fit, or "": healthy ones share values.
    const std::string& refusal() const { return refusal_; }
    long exceedances() const { return exceedances_; }
    double above() const { return above_; }  // the order statistic
    double shape() const { return shape_; }  // posterior means
    double scale() const { return scale_; }

    // Of a value from the order statistic on: its expected rate, and with `alarms` of `tested`
    // further healthy gearboxes beyond it the rate and interval that they leave.
    double rate(double value) const;
    HealthyRate rate(double value, long alarms, long tested, double confidence) const;
    // The value whose expected rate is `rate`, at most that of the order statistic.
    double threshold(double rate) const;
    // Where the value may lie whose rate is exactly `rate`.
    Interval threshold_interval(double rate, double confidence) const;

  private:
    struct Node {
        double pace, scale, weight;  // pace: shape / scale; in units of the median excess
    };
    std::vector<Node> posterior(const std::vector<double>& excess, double pace_low,
                                double pace_high, double log_scale_low,
                                double log_scale_high) const;
    // Of the share above the order statistic, some values that are equally likely.
    std::vector<double> shares() const;

    long sample_ = 0, exceedances_ = 0;
    double above_ = 0.0, unit_ = 1.0, shape_ = kNan, scale_ = kNan;
    std::vector<Node> nodes_;  // weights add to 1
    std::string refusal_;
};

}  // namespace gearpod::analysis
