// Noise of the transmission error signal after time-synchronous averaging.
//
// White noise of rms sigma_e on each sample of the transmission error is averaged over Z_r
// independent turns. The result is exactly white noise of variance sigma_e^2 / Z_r. The averaged
// noise is generated directly, one normal variate per averaged sample, and scaled to all noise
// levels.
#pragma once

#include <cmath>
#include <span>

#include "signals/noise/normals.hpp"

namespace gearpod::signals {

// Fills `noise` (one gearbox, Z_p P_te samples) for sigma_e = 1 and removes its mean, as is done
// for the signal. Engine: a 64-bit uniform random bit generator.
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
