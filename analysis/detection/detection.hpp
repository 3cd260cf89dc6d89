// Detection rates: alarms per fault size at a threshold taken from an independent healthy sample.
// MIL-HDBK-1823A, section 4; intervals: Wilson (1927), Clopper and Pearson (1934).
#pragma once

#include <span>
#include <string>

#include "analysis/detection/detection_table.hpp"

namespace gearpod::analysis {

// Values of one feature for one set of gearboxes, row-major: values[i * levels + level].
// NaN marks a gearbox that failed.
struct FeatureSample {
    std::span<const double> fault_size;  // one per gearbox
    std::span<const double> values;      // gearboxes x noise levels
    // Of a healthy sample of several records of each gearbox; weights of tilted ones.
    std::span<const std::size_t> gearbox = {};
    std::span<const double> weights = {};
};

// Thresholds from `healthy` (all of them, whatever their fault_size; healthy_thresholds.hpp), rates
// from `graded`. Intervals are of independent values or of tilted records: detect_clustered()
// (clusters.hpp) has those of several plain records of each gearbox.
// Throws std::invalid_argument if the shapes disagree.
FeatureDetection detect(const std::string& feature, Alarm alarm, const FeatureSample& healthy,
                        const FeatureSample& graded, const DetectionRequest& request);

}  // namespace gearpod::analysis
