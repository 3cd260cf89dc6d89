// Change of a gearbox since its baseline: the difference between its record and the mean of its
// baseline records, sample by sample.
#pragma once

#include <span>

#include "mc/gearbox/realization_signals.hpp"

namespace gearpod::mc {

// Change without noise. The record and its baseline records must have equally many sensor samples.
LaneSignals change_since_baseline(const Scene& scene, const LaneSignals& record,
                                  std::span<const LaneSignals* const> baselines);

// Noise of a baseline record. `rms`: that of its sensor noise divided by that of the test record.
struct BaselineNoise {
    const RealizationNoise* noise;
    double rms = 1.0;
};
// Noise of that change: the difference of the record's noise and the mean of the baselines'.
RealizationNoise noise_of_change(const Scene& scene, const LaneSignals& change,
                                 const RealizationNoise& record,
                                 std::span<const BaselineNoise> baselines);

}  // namespace gearpod::mc
