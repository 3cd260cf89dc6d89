// Whether samples are missing inside a recording that says nothing of it: what follows then comes
// too early. In steady running every turn (of the carrier, or the wheel) sounds like the one before
// it, so that their cross-correlation peaks at a lag of zero, or at the same small lag from turn to
// turn where the speed is a little off; a turn in which samples were lost is early, by them.
#pragma once

#include <optional>
#include <span>

namespace gearpod::signals {

struct LostSamples {
    double meshes = 0.0;  // mesh periods that are missing, give or take whole ones: -1/2 to 1/2
    int first_mesh = 0, last_mesh = 0;  // between which
    bool found = false;
};

// `samples`: evenly spaced in mesh phase, `per_mesh` a mesh period; `turn_meshes`: mesh periods of
// a turn. A loss is found if it stands out of the scatter of the lags, which counts as a twentieth
// of a sample at least. Empty where none would be noticed: fewer than six turns, turns that do not
// sound alike, or a signal that says nothing. Whole mesh periods that are missing are never
// noticed.
std::optional<LostSamples> lost_samples(std::span<const double> samples, int per_mesh,
                                        int turn_meshes);

}  // namespace gearpod::signals
