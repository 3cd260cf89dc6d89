// Alarm thresholds by importance sampling from weighted records of healthy gearboxes. Each gearbox
// has several records, most of them drawn towards an alarm by exponential tilting, with weights
// that correct for it (signals/windowing/noise_importance_sampler.hpp). The rate beyond a value is
// the mean over gearboxes of the weighted rate of each gearbox's records. It estimates the rate of
// plain records without the scatter of counting alarms: with some tens of records per gearbox, its
// error is that of the scatter between gearboxes.
//
// This scatter limits how rare a rate the sample supports. The interval is that of as many
// independent alarms as have the same relative variance (gamma distribution for clusters, fewer
// alarms for few gearboxes by Student's t: E. L. Korn, B. I. Graubard, Survey Methodology 24
// (1998), 193-201). There is no estimate if the effective number of contributing gearboxes, (sum
// p)^2 / sum p^2 of the gearboxes' own rates p, is below kLeastContributing.
//
// Rare gearboxes with the most alarms may be missing from a sample that looks sufficient. Two
// corrections account for this. They use scores: the score of a gearbox is the upper normal
// quantile of its own alarm rate p. First, the effective number is limited to that of normal scores
// with the scatter of the gearboxes that alarm more often than the median one. Second, the upper
// bound includes the rate of gearboxes rarer than one in the sample under an exponential tail of
// the scores, weighted by how exponential the tail looks; at most kMostUnseen of the rate.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "analysis/detection/detection_table.hpp"
#include "analysis/statistics/interval.hpp"

namespace gearpod::analysis {

inline constexpr double kLeastContributing = 20.0;
inline constexpr double kMostUnseen = 0.3;

class ImportanceSample {
  public:
    // Takes one value, weight and gearbox per record; the records of a gearbox are consecutive.
    // Values that are not finite raise no alarm. Gearboxes without any finite value are left out.
    ImportanceSample(std::span<const double> values, std::span<const double> weights,
                     std::span<const std::size_t> gearbox, Alarm alarm);

    struct Estimate {
        double threshold = 0.0;
        // Rate beyond the threshold: the requested one, or the estimate for a given threshold.
        double expected = 0.0;
        Interval rate;              // interval of that rate
        double contributing = 0.0;  // effective number of contributing gearboxes
        double variance = 0.0;      // relative variance of `expected`
        long alarms = 0;            // records beyond it, whatever their weight
    };
    // Value with the largest estimated rate that does not exceed `rate`. Empty if too few gearboxes
    // contribute.
    std::optional<Estimate> threshold(double rate, double confidence) const;
    // Estimate at a given threshold. Empty if too few gearboxes contribute.
    std::optional<Estimate> at(double threshold, double confidence) const;
    // Interval of the value whose rate is exactly `rate`; `estimate` is the result of threshold().
    Interval threshold_interval(double rate, const Estimate& estimate) const;

    long records() const { return records_; }  // with a finite value
    long gearboxes() const { return gearboxes_; }

  private:
    struct Record {
        // Value times alarm_sign(); weight over the number of the gearbox's records.
        double value, share;
        std::size_t gearbox;  // numbered from 0
    };
    // Number of the largest values with an estimated rate of at most `rate`.
    std::size_t count_beyond(double rate) const;
    std::vector<double> own_rates(std::size_t beyond) const;
    // Estimate at a threshold with the given number of records beyond it and the given rate.
    std::optional<Estimate> estimate(std::size_t beyond, double rate, double confidence) const;

    double sign_;
    long records_ = 0, gearboxes_ = 0;
    std::vector<Record> descending_;  // by descending value
    std::vector<double> cumulative_;  // estimated rate of the first records
};

}  // namespace gearpod::analysis
