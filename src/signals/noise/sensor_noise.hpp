// Noise of the averaged transmission error and of the sensor: drawn at the level of averages and
// folds, so that it costs as little as they do.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <vector>

#include "signals/noise/chi_squared.hpp"
#include "signals/noise/normals.hpp"

namespace gearpod::signals {

// Noise of the transmission error signal after time-synchronous averaging.
//
// White noise of rms sigma_e on each sample of the transmission error is averaged over Z_r
// independent turns. The result is exactly white noise of variance sigma_e^2 / Z_r. The averaged
// noise is generated directly, one normal variate per averaged sample, and scaled to all noise
// levels.

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

// Additive white sensor noise of rms sigma per sample, added after the low-pass filter.
// coloured_noise.hpp generates coloured noise.
//
// A folded bin (folded_signal.hpp) is a sum of Z_r squares. With noise it is exactly sigma^2 times
// a noncentral chi-square variable. Split into parts along and across the noise-free samples, it is
//
//     F_noisy = (sigma Z + sqrt F)^2 + sigma^2 G,    Z ~ N(0,1),    G ~ chi^2(Z_r - 1),
//
// independent between bins. Two random numbers per bin therefore replace the Z_r noise samples, and
// the same two serve all noise levels (windowing.hpp).

// Noise variates (Z, G) of every bin of one gearbox.
struct NoiseVariates {
    std::vector<double> along;   // Z
    std::vector<double> across;  // G
};

class SensorNoise {
  public:
    // Throws std::invalid_argument unless ring_teeth >= 3.
    explicit SensorNoise(int ring_teeth) : across_(ring_teeth - 1) {}

    // Draws all Z first, then all G. Engine: a 64-bit uniform random bit generator.
    template <typename Engine>
    void draw(Engine& engine, std::size_t bins, NoiseVariates& out) const {
        out.along.resize(bins);
        out.across.resize(bins);
        draw_normals(engine, out.along);
        draw_normals(engine, out.across);
        across_.from_normal(out.across);
    }

  private:
    ChiSquaredTransform across_;
};

// Unit noise n of one bin: sigma n, in m/s^2, turns the bin's Z_r noise-free samples into noisy
// samples. The squares of the noisy samples sum to exactly the bin's F_noisy. The noise is Z along
// the samples and sqrt(G) in a random direction across them; `normals`, Z_r further standard
// normals, give that direction. Throws std::invalid_argument on unequal sizes or fewer than two
// samples.
void noise_of_bin(std::span<const double> samples, double along, double across,
                  std::span<const double> normals, std::span<double> noise);

// Noise variates equivalent to a given noise of every sample, whatever its spectrum. Z = n s / |s|
// over each bin's samples s (0 where s is 0) and G = |n|^2 - Z^2, so that F_noisy is that of the
// noisy signal at every noise level. `signal` and `noise` have the same size, whole turns of
// `bins`.
NoiseVariates noise_variates_of_samples(std::span<const double> signal,
                                        std::span<const double> noise, std::size_t bins);

// Unit noise of every sample of a time signal (synthesize, whole span: Z_p Z_r P samples). With
// sigma times this noise the signal folds to F_noisy. Bins are processed in order b = 0, 1, ...;
// the engine gives the directions.
template <typename Engine>
std::vector<double> unit_noise(std::span<const double> signal, std::size_t bins,
                               const NoiseVariates& draw, Engine& engine) {
    if (bins == 0 || signal.size() % bins != 0 || draw.along.size() != bins ||
        draw.across.size() != bins) {
        throw std::invalid_argument("unit noise: signal, bins and draw disagree in size");
    }
    const std::size_t turns = signal.size() / bins;
    std::vector<double> all(signal.size());
    // Processes eight bins, a cache line of the signal, at a time.
    constexpr std::size_t kBlock = 8;
    std::vector<double> samples(kBlock * turns), normals(kBlock * turns), noise(kBlock * turns);
    for (std::size_t b = 0; b < bins; b += kBlock) {
        const std::size_t count = std::min(kBlock, bins - b);
        for (std::size_t i = 0; i < turns; ++i) {
            for (std::size_t c = 0; c < count; ++c) {
                samples[c * turns + i] = signal[i * bins + b + c];
            }
        }
        draw_normals(engine, normals);
        for (std::size_t c = 0; c < count; ++c) {
            const auto of_bin = [&](std::vector<double>& values) {
                return std::span(values).subspan(c * turns, turns);
            };
            noise_of_bin(of_bin(samples), draw.along[b + c], draw.across[b + c], of_bin(normals),
                         of_bin(noise));
        }
        for (std::size_t i = 0; i < turns; ++i) {
            for (std::size_t c = 0; c < count; ++c) {
                all[i * bins + b + c] = noise[c * turns + i];
            }
        }
    }
    return all;
}

}  // namespace gearpod::signals
