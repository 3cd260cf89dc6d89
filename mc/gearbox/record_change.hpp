// What has changed in a gearbox since its baseline record: record less baseline, sample by sample.
#pragma once

#include "mc/gearbox/instance_signals.hpp"

namespace gearpod::mc {

// Without noise. `record` has a baseline; both have the sensor's samples.
LaneSignals change_since_baseline(const Scene& scene, const LaneSignals& record);

// Of the same: the noises of both, in the form in which a drawn one is given. `baseline_rms`: of
// the sensor's noise in the baseline record, over that in the other.
NoiseOfInstance noise_of_change(const Scene& scene, const LaneSignals& change,
                                const NoiseOfInstance& record, const NoiseOfInstance& baseline,
                                double baseline_rms);

}  // namespace gearpod::mc
