// Alarm threshold from a healthy sample at a stated false-alarm rate.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "analysis/detection/detection_table.hpp"
#include "analysis/detection/false_alarm_rate.hpp"
#include "analysis/detection/importance_sample.hpp"
#include "analysis/detection/tail.hpp"

namespace gearpod::analysis {

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

// Returns the ceil((n+1)(1-rate))-th smallest of n values (largest for a low alarm). A further
// healthy gearbox from the same population lies strictly beyond the r-th smallest of n with an
// expected probability of (n+1-r)/(n+1), whatever the distribution. This is therefore the tightest
// order statistic that keeps the rate. Where it would need more than n values, the threshold is
// extrapolated as far as the tail permits (tail.hpp). Values that are not finite are left out.
Threshold alarm_threshold(std::vector<double> healthy, Alarm alarm, double false_alarm_rate);

// The same for several rates of one sample, which is sorted and whose tail is fitted once. An
// object belongs to one thread.
class SortedSample {
  public:
    SortedSample(std::vector<double> healthy, Alarm alarm);

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

}  // namespace gearpod::analysis
