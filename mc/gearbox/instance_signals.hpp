// One gearbox's signals at every noise level, as features look at them.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "features/feature.hpp"
#include "mc/gearbox/gearbox_tile.hpp"
#include "mc/gearbox/span_analysis.hpp"
#include "mc/scene/sampling.hpp"
#include "mc/scene/scene.hpp"
#include "signals/noise/sensor_noise.hpp"
#include "signals/spectra/order_spectrum.hpp"
#include "signals/windowing/windowing.hpp"

namespace gearpod::mc {

// The unit noise of every sample of a gearbox's noise-free sensor signal, which begins with the
// span: there it folds to what `draw` says, and beyond it is drawn sample by sample.
std::vector<double> sample_noise(const Scene& scene, std::span<const double> clean,
                                 const signals::NoiseDraw& draw, const GearboxId& id);
// samples[i] += sigma * unit[i]
void add_noise(std::span<const double> unit, double sigma, std::span<double> samples);

// What the noise adds to one gearbox, for all noise levels.
struct NoiseOfInstance {
    signals::NoiseDraw sensor;
    std::vector<double> encoder;  // for a level of 1 rad rms
};

// A gearbox's signals as features look at them. Holds scratch memory: one object per thread.
class InstanceSignals {
  public:
    // For features with these needs.
    InstanceSignals(const Scene& scene, unsigned needs);

    // Mesh periods of sensor signal that LaneSignals must hold, perhaps none.
    int meshes() const { return needs_samples_ ? scene_.signal_meshes() : 0; }

    // visit(level, input) for every noise level; `input` is valid during the call.
    void each_level(const LaneSignals& gearbox, const InstanceInputs& inputs, const GearboxId& id,
                    const std::function<void(std::size_t, const features::FeatureInput&)>& visit);

    // The noise that each_level() used last.
    const NoiseOfInstance& noise() const { return noise_; }
    // Seconds that drawing noise has taken so far.
    double noise_s() const { return noise_s_; }

  private:
    // Whether any level adds noise to the sensor.
    bool senses_noise(const InstanceInputs& inputs) const;
    // Zeros for what no level adds.
    void draw_noise(const LaneSignals& gearbox, const InstanceInputs& inputs, const GearboxId& id);
    void load_windows(const LaneSignals& gearbox, const InstanceInputs& inputs);
    // At one noise level, rms in m/s^2 and rad.
    void sensor_features(const LaneSignals& gearbox, double noise, features::FeatureInput& input);
    void te_features(const LaneSignals& gearbox, double noise, features::FeatureInput& input);

    const Scene& scene_;
    signals::SensorNoise sensor_noise_;
    signals::Windowing windowing_;
    signals::OrderSpectrum spectrum_;
    SpanAnalysis analysis_;
    bool needs_samples_;
    const double highest_level_;
    NoiseOfInstance noise_;
    std::vector<double> unit_noise_;  // of every sample
    std::vector<double> te_, samples_, amplitude_, tooth_rms_;
    double noise_s_ = 0.0;
};

}  // namespace gearpod::mc
