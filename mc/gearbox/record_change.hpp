// Change of a gearbox since its baseline record: the difference of both, sample by sample.
#pragma once

#include "mc/gearbox/realization_signals.hpp"

namespace gearpod::mc {

// Change without noise. `record` must have a baseline, and both must have sensor samples.
LaneSignals change_since_baseline(const Scene& scene, const LaneSignals& record);

// Noise of that change: the difference of the noises of both records. `baseline_rms`: rms of the
// sensor noise in the baseline record divided by that in the test record.
RealizationNoise noise_of_change(const Scene& scene, const LaneSignals& change,
                                 const RealizationNoise& record, const RealizationNoise& baseline,
                                 double baseline_rms);

}  // namespace gearpod::mc
