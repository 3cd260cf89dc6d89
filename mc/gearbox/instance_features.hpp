// From one gearbox's signals to its features at every noise level.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "features/feature.hpp"
#include "mc/gearbox/gearbox_tile.hpp"
#include "mc/gearbox/healthy_reference.hpp"
#include "mc/gearbox/span_analysis.hpp"
#include "mc/random/philox.hpp"
#include "mc/scene/sampling.hpp"
#include "mc/scene/scene.hpp"
#include "signals/noise/sensor_noise.hpp"
#include "signals/spectra/order_spectrum.hpp"
#include "signals/windowing/windowing.hpp"

namespace gearpod::mc {

// The random stream of an instance's sensor noise, of its encoder noise, and of the directions that
// spell a drawn sensor noise out sample by sample.
Philox sensor_noise_stream(const Study& study, Group group, std::uint64_t instance);
Philox encoder_noise_stream(const Study& study, Group group, std::uint64_t instance);
Philox noise_direction_stream(const Study& study, Group group, std::uint64_t instance);

// The layout that windowing looks at.
signals::SpanLayout span_layout(const Scene& scene);

// The features that a study uses, in its order; all their needs (features::Need).
std::vector<const features::Feature*> used_features(const Study& study);
unsigned needs_of(std::span<const features::Feature* const> features);

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

// What the features of one noise level look at.
struct LevelSignals {
    std::vector<double> te_turn;    // rad, Z_p P_te samples
    std::vector<double> tooth_rms;  // m/s^2, Z_p; empty without a sensor
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

// The features that a study uses.
class InstanceFeatures : public InstanceSignals {
  public:
    // `healthy` is that of healthy_reference() and outlives the object.
    InstanceFeatures(const Scene& scene, const HealthyReference* healthy);

    // Values of all used features: [feature * noise levels + level]. `signals` gets what they look
    // at, an entry a noise level, unless it is null.
    std::vector<double> compute(const LaneSignals& gearbox, const InstanceInputs& inputs,
                                const GearboxId& id, std::vector<LevelSignals>* signals = nullptr);

  private:
    std::vector<const features::Feature*> features_;
    const HealthyReference* healthy_;
    std::size_t levels_;
};

}  // namespace gearpod::mc
