// Features of a study and the length of the signals that they need.
#pragma once

#include <span>
#include <vector>

#include "features/feature.hpp"
#include "mc/study/study.hpp"
#include "signals/tile_signals.hpp"
#include "signals/windowing/tooth_signals.hpp"

namespace gearpod::mc {

// used_features(): features that a study uses, in its order. needs_of(): signals of its test
// records and of their changes that they need.
std::vector<const features::Feature*> used_features(const Study& study);
features::SignalSet needs_of(std::span<const features::Feature* const> features);

// Needs by the signal that they refer to: the test record, the baseline record, and the change
// between them.
struct ComparedNeeds {
    features::SignalSet record, baseline, change;
};
ComparedNeeds compared_needs(std::span<const features::Feature* const> features);

// True if features with these needs use the sensor's samples.
bool needs_samples(features::SignalSet needs);
// Number of mesh periods of sensor signal that features with these needs use.
int meshes_needed(const Study& study, const signals::SpanLayout& span, features::SignalSet needs);

// Number of a central gear's turns that fit into the span, or the smallest number that is enough.
signals::GearTurns central_turns(const signals::SpanLayout& span, int teeth);

}  // namespace gearpod::mc
