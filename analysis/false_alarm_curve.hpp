// What a rarer false alarm costs in size: a90 at thresholds for false-alarm rates from 0.1 down to
// 1e-6, as far as the healthy sample carries them (detection/tail.hpp); and in money, where an
// alarm and a miss have a price.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/detection/detection_table.hpp"
#include "analysis/detection/healthy_thresholds.hpp"
#include "analysis/pod/pod_curve.hpp"
#include "analysis/pod/size_estimate.hpp"
#include "analysis/statistics/interval.hpp"

namespace gearpod::analysis {

inline constexpr std::array kCurveRates{1e-1, 5e-2, 2e-2, 1e-2, 5e-3, 2e-3, 1e-3, 5e-4,
                                        2e-4, 1e-4, 5e-5, 2e-5, 1e-5, 5e-6, 2e-6, 1e-6};

struct RatePoint {
    double false_alarm_rate = 0.0;  // asked for
    double threshold = 0.0;
    double extrapolation = 0.0;  // so many times beyond the sample; 0: an order statistic
    bool tilted = false;         // of tilted records, beyond as many gearboxes
    Interval threshold_bounds;   // an infinite side: the sample does not fix it
    // The bounds also hold the threshold's own scatter: a90's at the threshold's, each with half
    // the chance of error.
    SizeBounds a90;
};

struct FalseAlarmCurve {
    std::vector<RatePoint> points;  // falling rates, the last the rarest that the sample carries
    std::vector<double> unfitted;   // rates between them at which no curve fits
    std::string refusal;            // why there are none, or ""
};

// One feature at one noise level.
struct GradedValues {
    Alarm alarm = Alarm::high;
    HealthyValues healthy;  // threshold sample
    std::span<const double> size, value;
};

// With the forms of the curves that the data support at the request's own rate, the one taken there
// first: estimates are its own, bounds the widest, as in a POD (hit_miss_pod.hpp); floors follow
// the rates. A rarer alarm finds no smaller fault, so neither a90 nor its bounds fall with the
// rate: estimate and upper bound are at least those of any higher rate, the lower bound at most
// that of any lower one.
FalseAlarmCurve false_alarm_curve(const GradedValues& values, std::span<const PodForm> forms,
                                  double confidence);

// In any unit of money, the same for both; the share of records of machines with a fault.
struct Costs {
    double alarm = 0.0, miss = 0.0, fault_share = 0.0;
};

struct LeastCost {
    double threshold = 0.0;
    double extrapolation = 0.0;  // as above
    bool tilted = false;
    double false_alarm_rate = 0.0;
    Interval rate_bounds;
    double pd = 0.0;  // of the study's faults, all sizes as they were drawn
    Interval pd_bounds;
    double cost = 0.0;     // expected, of a record
    Interval bounds;       // from both, each with half the chance of error
    double without = 0.0;  // without any alarm
    bool rarest = false;   // the least lies at the rarest rate that the sample carries, or beyond
};

// (1 - share) rate alarm + share (1 - Pd) miss, the least over the thresholds for the curve's rates
// and for every order statistic of the healthy sample. None without healthy or faulty values.
std::optional<LeastCost> least_cost(const GradedValues& values, const Costs& costs,
                                    double confidence);

}  // namespace gearpod::analysis
