// One gearbox's signals at every noise level, as features look at them.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "features/feature.hpp"
#include "mc/gearbox/gearbox_tile.hpp"
#include "mc/gearbox/span_analysis.hpp"
#include "mc/scene/sampling.hpp"
#include "mc/scene/scene.hpp"
#include "signals/noise/low_pass_noise.hpp"
#include "signals/noise/sensor_noise.hpp"
#include "signals/spectra/order_spectrum.hpp"
#include "signals/windowing/noise_tilt.hpp"
#include "signals/windowing/windowing.hpp"

namespace gearpod::mc {

// The unit noise of every sample of a gearbox's noise-free sensor signal, which begins with the
// span: there it folds to what `draw` says, and beyond it is drawn sample by sample.
// Noise given by its density is drawn sample by sample throughout, and `draw` follows from it.
std::vector<double> sample_noise(const Scene& scene, const InstanceInputs& inputs,
                                 std::span<const double> clean, const signals::NoiseDraw& draw,
                                 const GearboxId& id);
// The unit noise behind the low-pass of a sensor whose noise is given by density. Where the speed
// fluctuates, samples count as spaced evenly.
signals::LowPassNoise low_pass_noise(const Scene& scene, const InstanceInputs& inputs);
// samples[i] += sigma * unit[i]
void add_noise(std::span<const double> unit, double sigma, std::span<double> samples);

// What the noise adds to one gearbox, for all noise levels.
struct NoiseOfInstance {
    signals::NoiseDraw sensor;
    std::vector<double> samples;  // the same of every sample of LaneSignals::sensor, unit rms
    std::vector<double> encoder;  // for a level of 1 rad rms
};

// A gearbox's signals as features look at them. Holds scratch memory: one object per thread.
class InstanceSignals {
  public:
    // For features with these needs.
    InstanceSignals(const Scene& scene, unsigned needs);
    // The same of signals folded over so many turns of a planet, not over the scene's span: for
    // features that look at no samples. At least 3.
    InstanceSignals(const Scene& scene, unsigned needs, int turns);

    // Mesh periods of sensor signal that LaneSignals must hold, perhaps none.
    int meshes() const { return meshes_; }

    // The next gearbox, which must live as long as at() is asked for it: with noise drawn for it,
    // or with that noise.
    void load(const LaneSignals& gearbox, const InstanceInputs& inputs, const GearboxId& id);
    void load(const LaneSignals& gearbox, const InstanceInputs& inputs, NoiseOfInstance noise);
    // The gearbox at a noise level; valid until the next call.
    features::FeatureInput at(std::size_t level);

    const NoiseOfInstance& noise() const { return noise_; }
    // Of the gearbox and draws that were loaded last; 1 of plain ones.
    double noise_weight() const;
    // Seconds that drawing noise has taken so far.
    double noise_s() const { return noise_s_; }

  private:
    // Whether any level adds noise to the sensor.
    bool senses_noise(const InstanceInputs& inputs) const;
    void draw_sensor_noise(const LaneSignals& gearbox, const InstanceInputs& inputs,
                           const GearboxId& id);
    // The record's kind, from its number.
    void tilt_sensor_noise(const LaneSignals& gearbox, const InstanceInputs& inputs,
                           const GearboxId& id);
    // Zeros for what no level adds.
    void draw_noise(const LaneSignals& gearbox, const InstanceInputs& inputs, const GearboxId& id);
    void load_signals(const LaneSignals& gearbox, const InstanceInputs& inputs);
    // At one noise level, rms in m/s^2 and rad.
    void sensor_features(double noise, features::FeatureInput& input);
    void te_features(double noise, features::FeatureInput& input);

    const Scene& scene_;
    const signals::SpanLayout span_;
    signals::SensorNoise sensor_noise_;
    signals::Windowing windowing_;
    std::optional<signals::NoiseTilt> tilt_;  // of the last gearbox whose noise is tilted
    GearboxId tilted_;                        // which that is
    bool is_tilted_ = false;                  // the record loaded last
    signals::OrderSpectrum spectrum_;
    SpanAnalysis analysis_;
    bool needs_samples_;
    int meshes_;
    const double highest_level_;
    const LaneSignals* gearbox_ = nullptr;
    double sensor_rms_ = 0.0, encoder_rms_ = 0.0;  // of the noise at level 1, m/s^2 and rad
    NoiseOfInstance noise_;
    std::vector<double> te_, samples_, amplitude_, tooth_rms_;
    double noise_s_ = 0.0;
};

}  // namespace gearpod::mc
