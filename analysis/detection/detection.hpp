// Detection rates: alarms per fault size at a threshold from an independent healthy sample.
// MIL-HDBK-1823A, section 4; intervals: Wilson (1927), Clopper and Pearson (1934).
#pragma once

#include <span>
#include <string>

#include "analysis/detection/detection_table.hpp"

namespace gearpod::analysis {

// Values of one feature for one set of gearboxes, row-major: values[i * levels + level]. NaN marks
// a failed gearbox.
struct FeatureSample {
    std::span<const double> fault_size;  // one per gearbox
    std::span<const double> values;      // gearboxes x noise levels
    // Gearbox of each row of a healthy sample with several records per gearbox, and
    // importance-sampling weights of the records.
    std::span<const std::size_t> gearbox = {};
    std::span<const double> weights = {};
};

// Sets thresholds from all of `healthy`, whatever their fault_size (healthy_thresholds.hpp), and
// computes rates from `graded`. Intervals assume independent values or importance-sampled records;
// use detect_clustered() (clusters.hpp) for several plain records of each gearbox. Throws
// std::invalid_argument if the shapes disagree, the false-alarm rate is not between 0 and 1, or the
// size groups do not ascend.
FeatureDetection detect(const std::string& feature, Alarm alarm, const FeatureSample& healthy,
                        const FeatureSample& graded, const DetectionRequest& request);

}  // namespace gearpod::analysis
