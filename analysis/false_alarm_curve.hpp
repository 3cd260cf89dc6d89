// Detectable size against false-alarm rate: a90 at thresholds for rates from 0.1 down to 1e-6, as
// far as the healthy sample supports them (analysis/detection/threshold.hpp).
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/detection/detection_table.hpp"
#include "analysis/detection/threshold.hpp"
#include "analysis/pod/pod_curve.hpp"
#include "analysis/statistics/interval.hpp"
#include "machine/fields.hpp"

namespace gearpod::analysis {

inline constexpr std::array kCurveRates{1e-1, 5e-2, 2e-2, 1e-2, 5e-3, 2e-3, 1e-3, 5e-4,
                                        2e-4, 1e-4, 5e-5, 2e-5, 1e-5, 5e-6, 2e-6, 1e-6};

struct RatePoint {
    double false_alarm_rate = 0.0;  // requested
    double threshold = 0.0;
    // Ratio of the tail's rarity to the sample's: 1 / (rate x sample size); 0: an order statistic.
    double extrapolation = 0.0;
    // Threshold from importance sampling; `extrapolation` then counts gearboxes.
    bool importance_sampled = false;
    Interval threshold_bounds;  // an infinite bound means that the sample does not determine it
    // Bounds that include the uncertainty of the threshold: a90's bounds at the bounds of the
    // threshold, each with half of the error probability.
    SizeBounds a90;
};
GEARPOD_FIELDS(RatePoint, false_alarm_rate, threshold, extrapolation_, tilted, threshold_bounds,
               a90)

struct FalseAlarmCurve {
    // In order of falling rate, the last at the rarest rate that the sample supports.
    std::vector<RatePoint> points;
    std::vector<double> unfitted;  // rates within that range at which no curve fits
    std::string refusal;           // reason why there are no points, or ""
};
GEARPOD_FIELDS(FalseAlarmCurve, points, unfitted, refusal)

// Values of one feature at one noise level.
struct TestValues {
    Alarm alarm = Alarm::high;
    HealthyValues healthy;  // threshold sample
    std::span<const double> size, value;
};

// Computes a90 at every rate of kCurveRates. Uses the curve forms that the data support at the
// requested rate, the chosen one first: estimates come from the first form, bounds are the widest
// of all forms, as in a POD (hit_miss_pod.hpp). The floor of a curve follows the false-alarm rate.
// A rarer false alarm cannot find a smaller fault, so a90 and both of its bounds are made monotone:
// none of them falls as the rate falls.
FalseAlarmCurve false_alarm_curve(const TestValues& values, std::span<const PodForm> forms,
                                  double confidence);

}  // namespace gearpod::analysis
