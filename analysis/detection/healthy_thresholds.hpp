// Thresholds at any false-alarm rate from one healthy sample, of whatever kind.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "analysis/detection/threshold.hpp"

namespace gearpod::analysis {

// The values of a healthy sample. Without gearboxes each value is of one of its own.
struct HealthyValues {
    std::span<const double> values;
    std::span<const std::size_t> gearbox = {};  // tilted records of one follow one another
    std::span<const double> weights = {};       // of tilted records (tilted_sample.hpp)

    bool clustered() const;
};

// Of plain values: alarm_threshold(). Of several plain records of each gearbox: the same order
// statistics, and none beyond the sample, whose tail is not known (clustered_rate.hpp). Of tilted
// records: tilted_sample.hpp, and where too few gearboxes carry the rate, alarm_threshold() of the
// first record of each, which is plain.
class HealthyThresholds {
  public:
    HealthyThresholds(const HealthyValues& sample, Alarm alarm);

    Threshold at(double false_alarm_rate, double confidence) const;
    // Where the value may lie whose rate is exactly the one asked for; `threshold` is at()'s.
    Interval value_bounds(const Threshold& threshold, double false_alarm_rate,
                          double confidence) const;
    // Of the rate of that threshold.
    Interval rate_bounds(const Threshold& threshold, double false_alarm_rate,
                         double confidence) const;

    // What order statistics are taken of: all plain values, or the first record of each gearbox.
    const std::vector<double>& plain() const { return plain_; }

  private:
    Alarm alarm_;
    std::vector<double> plain_;
    std::vector<std::size_t> gearbox_;  // of these, if several are of one
    std::optional<TiltedSample> tilted_;
};

}  // namespace gearpod::analysis
