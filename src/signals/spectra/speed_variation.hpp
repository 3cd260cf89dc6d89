// Variation of the speed within a recording that was resampled with a constant one.
//
// The spectra of neighbouring parts differ by a stretch if the speed differs. Each part is compared
// with the parts before it, so that all lines are followed and none has to be identified. The phase
// that results is confirmed by the spectrum of the whole recording: resampled with it, the lines
// must be narrower. Noise, short recordings and a constant speed give no such phase.
#pragma once

#include <optional>
#include <span>

namespace gearpod::signals {

struct SpeedVariation {
    double speed = 0.0;   // largest less least speed of the parts, relative to the mean
    double meshes = 0.0;  // largest less least deviation of the mesh phase, mesh periods
};

// `samples` are evenly spaced in the assumed mesh phase, `per_mesh` per mesh period. Empty if no
// variation is confirmed. Variations within fewer than some 25 mesh periods are not found.
std::optional<SpeedVariation> speed_variation(std::span<const double> samples, int per_mesh);

}  // namespace gearpod::signals
