// Alarm thresholds and false-alarm rates from healthy records, also from several records of each
// gearbox or from importance sampling.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "analysis/detection/detection_table.hpp"
#include "analysis/detection/threshold.hpp"
#include "analysis/statistics/interval.hpp"

namespace gearpod::analysis {

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
// - Plain values: alarm_threshold().
// - Several plain records per gearbox: the same order statistics, without extrapolation, because
//   the tail of clustered values is not known.
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
