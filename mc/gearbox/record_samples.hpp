// Sampling of a scene's records, and the samples of a record that are folded over planet turns.
#pragma once

#include <span>
#include <vector>

#include "mc/gearbox/gearbox_tile.hpp"

namespace gearpod::mc {

// Mean time between samples in a gearbox with these inputs, s.
double sample_s(const Scene& scene, const InstanceInputs& inputs);

// Samples in a turn of the monitored gear.
std::size_t turn_samples(const Scene& scene);

// Part of a signal that is folded: the record's turns, or the span. The signal may continue after
// it.
std::span<const double> folded_part(const Scene& scene, const LaneSignals& record,
                                    std::span<const double> samples);

// Folds a record's sensor samples again after a change.
void fold_again(const Scene& scene, LaneSignals& record);

}  // namespace gearpod::mc
