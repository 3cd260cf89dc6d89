// Noise of the transmission error signal after time-synchronous averaging.
//
// White noise of rms sigma_e on each sample of the transmission error becomes, in the mean over the
// Z_r independent turns, exactly white noise of variance sigma_e^2 / Z_r: it is drawn there, one
// normal per averaged sample, and serves all noise levels by scaling.
#pragma once

#include <cmath>
#include <span>

#include "signals/noise/normals.hpp"

namespace gearpod::signals {

// Fills `noise` (one gearbox, Z_p P_te samples) for sigma_e = 1, its mean removed like the
// signal's. Engine: a 64-bit uniform random bit generator.
template <typename Engine>
void draw_encoder_noise(Engine& engine, int ring_teeth, std::span<double> noise) {
    draw_normals(engine, noise);
    const double scale = 1.0 / std::sqrt(ring_teeth);
    double sum = 0.0;
    for (double& value : noise) {
        value *= scale;
        sum += value;
    }
    const double mean = noise.empty() ? 0.0 : sum / static_cast<double>(noise.size());
    for (double& value : noise) {
        value -= mean;
    }
}

}  // namespace gearpod::signals
