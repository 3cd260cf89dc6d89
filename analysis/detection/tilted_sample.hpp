// Alarm thresholds from weighted records of healthy gearboxes: several of each, most of them drawn
// towards an alarm, with weights that undo it (signals/windowing/noise_tilt.hpp). The mean over the
// gearboxes of what each one's records say of the rate beyond a value is that of plain records,
// without the scatter of counting alarms: with some tens of records a gearbox the rate's error is
// that of how gearboxes differ.
//
// How much they do limits how rare a rate they carry: the interval is that of as many independent
// alarms as have the same relative variance (gamma law, cluster by cluster, less for few
// gearboxes by Student's t: E. L. Korn, B. I. Graubard, Survey Methodology 24 (1998), 193-201), and
// there is none where fewer than kLeastCarrying gearboxes carry the rate, (sum p)^2 / sum p^2 of
// the gearboxes' own rates p. Rare gearboxes that have the most alarms may be missing from a sample
// that looks well carried, so the number is also not taken larger than normal scores would have
// it, with the scatter of the gearboxes that alarm more often than the median one; and the upper
// end has what gearboxes rarer than one in the sample add if the scores' tail goes on
// exponentially, so far as it looks like that: at most kMostUnseen of the rate.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "analysis/detection/detection_table.hpp"
#include "analysis/statistics/interval.hpp"

namespace gearpod::analysis {

inline constexpr double kLeastCarrying = 20.0;
inline constexpr double kMostUnseen = 0.3;

class TiltedSample {
  public:
    // One value, weight and gearbox a record; the records of a gearbox follow one another. Values
    // that are not finite raise no alarm; gearboxes without any finite one are left out.
    TiltedSample(std::span<const double> values, std::span<const double> weights,
                 std::span<const std::size_t> gearbox, Alarm alarm);

    struct Estimate {
        double threshold = 0.0;
        double expected = 0.0;  // rate beyond it
        Interval rate;          // of the same
        double carrying = 0.0;  // gearboxes
        double variance = 0.0;  // of `expected`, relative
        long alarms = 0;        // records beyond it, whatever their weight
    };
    // The value with the largest estimated rate that is not above `rate`. Empty where too few
    // gearboxes carry it.
    std::optional<Estimate> threshold(double rate, double confidence) const;
    // Of any threshold. Empty likewise.
    std::optional<Estimate> at(double threshold, double confidence) const;
    // Where the value may lie whose rate is exactly `rate`; `estimate` is threshold()'s.
    Interval threshold_interval(double rate, const Estimate& estimate) const;

    long records() const { return records_; }  // with a finite value
    long gearboxes() const { return gearboxes_; }

  private:
    struct Record {
        double value, share;  // away from the alarm negated; weight over the gearbox's records
        std::size_t gearbox;  // numbered from 0
    };
    // How many of the largest have an estimated rate of at most `rate`.
    std::size_t beyond(double rate) const;
    std::vector<double> own_rates(std::size_t beyond) const;
    // Of a threshold with so many records beyond it, for what is taken for their rate.
    std::optional<Estimate> estimate(std::size_t beyond, double rate, double confidence) const;

    double sign_;
    long records_ = 0, gearboxes_ = 0;
    std::vector<Record> falling_;     // by value
    std::vector<double> cumulative_;  // rate of the first so many
};

}  // namespace gearpod::analysis
