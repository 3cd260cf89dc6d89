// Thresholds at any false-alarm rate from a healthy sample of any kind.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "analysis/detection/threshold.hpp"

namespace gearpod::analysis {

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
// - Plain values: alarm_threshold().
// - Several plain records per gearbox: the same order statistics, without extrapolation, because
//   the tail of clustered values is not known (clustered_rate.hpp).
// - Importance-sampled records: importance_sample.hpp. Where too few gearboxes contribute,
//   alarm_threshold() of the first record of each gearbox, which is plain.
class HealthyThresholds {
  public:
    HealthyThresholds(const HealthyValues& sample, Alarm alarm);

    Threshold at(double false_alarm_rate, double confidence) const;
    // Interval of the value whose rate is exactly the requested one; `threshold` is the result of
    // at().
    Interval value_bounds(const Threshold& threshold, double false_alarm_rate,
                          double confidence) const;
    // Interval of the rate of that threshold.
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
