// From one gearbox's folded sensor signal and averaged TE to its features at every noise level.
#pragma once

#include <span>
#include <vector>

#include "features/feature.hpp"
#include "mc/philox.hpp"
#include "mc/sampling.hpp"
#include "mc/scene.hpp"
#include "signals/order_spectrum.hpp"
#include "signals/sensor_noise.hpp"
#include "signals/windowing.hpp"

namespace gearpod::mc {

// The random stream of an instance's sensor noise, of its encoder noise, and of the directions that
// spell a drawn sensor noise out sample by sample.
Philox sensor_noise_stream(const Study& study, Group group, std::uint64_t instance);
Philox encoder_noise_stream(const Study& study, Group group, std::uint64_t instance);
Philox noise_direction_stream(const Study& study, Group group, std::uint64_t instance);

// The layout that windowing looks at.
signals::SpanLayout span_layout(const Scene& scene);

// The features that a study uses, in its order.
std::vector<const features::Feature*> used_features(const Study& study);

// What the noise adds to one gearbox, for all noise levels.
struct NoiseOfInstance {
    signals::NoiseDraw sensor;
    std::vector<double> encoder;  // for a level of 1 rad rms
};

// What the features of one noise level look at.
struct LevelSignals {
    std::vector<double> te_turn;    // rad, Z_p P_te samples
    std::vector<double> tooth_rms;  // m/s^2, Z_p; empty without a sensor
};

// Holds scratch memory: one object per thread.
class InstanceFeatures {
  public:
    explicit InstanceFeatures(const Scene& scene);

    // Values of all used features: [feature * noise levels + level]. `folded`: Z_p P bins of
    // squared sensor signal; `te_turn`: Z_p P_te samples of averaged TE, rad. `signals` gets what
    // they look at, an entry a noise level, unless it is null.
    std::vector<double> compute(std::span<const double> folded, std::span<const double> te_turn,
                                const InstanceInputs& inputs, Group group, std::uint64_t instance,
                                std::vector<LevelSignals>* signals = nullptr);

    // The noise that compute() used last.
    const NoiseOfInstance& noise() const { return noise_; }
    // Seconds that drawing and adding noise has taken so far.
    double noise_s() const { return noise_s_; }

  private:
    void draw_noise(std::size_t bins, std::size_t te_samples, Group group, std::uint64_t instance);
    // Into folded_ and te_; rms in m/s^2 and rad.
    void add_noise(std::span<const double> folded, double sensor_noise,
                   std::span<const double> te_turn, double te_noise);

    const Scene& scene_;
    std::vector<const features::Feature*> features_;
    signals::SensorNoise sensor_noise_;
    signals::Windowing windowing_;
    signals::OrderSpectrum spectrum_;
    NoiseOfInstance noise_;
    std::vector<double> folded_, te_, amplitude_, tooth_rms_;
    double noise_s_ = 0.0;
};

}  // namespace gearpod::mc
