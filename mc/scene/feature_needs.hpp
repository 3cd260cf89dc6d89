// The features of a study, and how much of a gearbox's signals they look at.
#pragma once

#include <span>
#include <vector>

#include "features/feature.hpp"
#include "mc/study/study.hpp"
#include "signals/tile_signals.hpp"
#include "signals/windowing/tooth_signals.hpp"

namespace gearpod::mc {

// The features that a study uses, in its order; all their needs (features::Need).
std::vector<const features::Feature*> used_features(const Study& study);
unsigned needs_of(std::span<const features::Feature* const> features);

// Needs by the signals that they are of.
struct ComparedNeeds {
    unsigned record = 0, baseline = 0, change = 0;
};
ComparedNeeds compared_needs(std::span<const features::Feature* const> features);

// Whether features with these needs look at the sensor's samples.
bool needs_samples(unsigned needs);
// Mesh periods of sensor signal that features with these needs look at.
int meshes_needed(const Study& study, const signals::SpanLayout& span, unsigned needs);

// A central gear's turns in the span, or the fewest that do.
signals::GearTurns central_turns(const signals::SpanLayout& span, int teeth);

}  // namespace gearpod::mc
