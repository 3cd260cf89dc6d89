// Detection in an ensemble of which only some gearboxes were computed. The values of the others are
// predicted from those of an ensemble with the same random numbers: lines are fitted to the pairs,
// one for healthy gearboxes, one for faulty ones that also depends on the fault's size, and each
// prediction gets the residual of a pair. Logarithms are fitted where all values are positive.
#pragma once

#include <span>

#include "analysis/detection/detection_table.hpp"

namespace gearpod::analysis {

// One feature at one noise level, with the fault sizes of the test gearboxes.
struct FeatureValues {
    Alarm alarm = Alarm::high;
    std::span<const double> healthy;
    std::span<const std::size_t> gearbox;  // of each healthy value
    std::span<const double> test_size, test;
};

// Values of a gearbox in both ensembles, and its fault size.
struct ValuePair {
    double size = 0.0, own = 0.0, changed = 0.0;
};

struct PredictedDetection {
    // Smallest fault found with 90 % probability at the confidence of the request, SI; infinite:
    // none. Median of 39 resamples of the residuals, and their range, an interval at 95 %.
    double size = kNan, size_low = kNan, size_high = kNan;
    // Detection rate of the largest size group.
    double pd = kNan, pd_low = kNan, pd_high = kNan;
};

// Detection with the values as they are.
PredictedDetection detection_as_is(const FeatureValues& values, const DetectionRequest& request);
// NaN for fewer than four healthy or five faulty pairs with both values.
PredictedDetection predicted_detection(const FeatureValues& values,
                                       std::span<const ValuePair> pairs,
                                       const DetectionRequest& request, int threads);

}  // namespace gearpod::analysis
