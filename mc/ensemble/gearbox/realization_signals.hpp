// Signals of one gearbox at every noise level, in the form that features need.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "features/feature.hpp"
#include "mc/ensemble/gearbox/gearbox_tile.hpp"
#include "mc/ensemble/gearbox/span_analysis.hpp"
#include "mc/plan/sampling.hpp"
#include "mc/plan/sensor_plan.hpp"
#include "signals/noise/coloured_noise.hpp"
#include "signals/noise/normals.hpp"
#include "signals/noise/sensor_noise.hpp"
#include "signals/spectra/order_spectrum.hpp"
#include "signals/windowing/noise_importance_sampler.hpp"
#include "signals/windowing/windowing.hpp"

namespace gearpod::mc {

// Random numbers of the parts of a record's noise.
template <class Engine>
struct NoiseEngines {
    Engine& filtered;
    Engine& white;
    Engine& background;
};
// Draws unit noise with the spectrum of a stage that gives noise by density: the filtered part, and
// the white part and the background if there are any. Samples count as evenly spaced even if the
// speed fluctuates.
template <class Engine>
void draw_unit_noise(const NoiseStage& stage, const SensorNoise& noise, double sample_s,
                     NoiseEngines<Engine> engines, std::span<double> unit) {
    const double white = noise.white_m_s2 / noise.all_m_s2,
                 background = noise.background_m_s2 / noise.all_m_s2;
    if (stage.filtered) {
        signals::LowPassNoise(stage.low_pass_Hz() * sample_s).draw(engines.filtered, unit);
    } else {
        std::ranges::fill(unit, 0.0);
    }
    if (!(white > 0.0) && !(background > 0.0)) {
        return;
    }
    const double filtered_share =
        std::sqrt(1.0 - std::min(1.0, white * white + background * background));
    for (double& value : unit) {
        value *= filtered_share;
    }
    std::vector<double> part(unit.size());
    const auto add = [&](double share) {
        for (std::size_t i = 0; i < unit.size(); ++i) {
            unit[i] += share * part[i];
        }
    };
    if (white > 0.0) {
        signals::draw_normals(engines.white, std::span(part));
        add(white);
    }
    if (background > 0.0) {
        signals::ShapedNoise(*stage.background, stage.low_pass_Hz(), 1.0 / sample_s)
            .draw(engines.background, std::span(part));
        add(background);
    }
}
// Computes samples[i] += sigma * unit[i].
void add_noise(std::span<const double> unit, double sigma, std::span<double> samples);
// Unit noise for every sample of a gearbox's noise-free sensor signal. The signal begins with
// `turns` turns of the monitored gear. Within them, the noise folds exactly to `draw`; after them,
// each sample is independent. Noise that is drawn sample by sample throughout
// (NoiseStage::by_samples) does not use `draw`, which follows from it.
std::vector<double> sample_noise(const RecordPlan& plan, const NoiseStage& stage,
                                 const Realization& realization, std::span<const double> clean,
                                 const signals::NoiseVariates& draw, int turns);

// Noise of one gearbox, common to all noise levels.
struct RealizationNoise {
    signals::NoiseVariates sensor;
    std::vector<double> samples;  // unit rms, one per sample of LaneSignals::sensor; empty unless
                                  // they are used
    std::vector<double> encoder;  // for a noise level of 1 rad rms
};

// Signals of a gearbox with noise, at each noise level. Holds scratch memory: use one object per
// thread.
class RealizationSignals {
  public:
    // `needs`: signals that features need. `turns`: number of planet turns over which signals are
    // folded, at least 3, or 0 for the span; others than the span only for features that do not
    // need samples. Signals with LaneSignals::turns have their own number of turns. The plans must
    // outlive the object.
    RealizationSignals(const RecordPlan& plan, const FeaturePlan& features,
                       const SensorPlan& sensor, features::SignalSet needs, int turns = 0);

    // Number of mesh periods of sensor signal that LaneSignals must hold; may be 0.
    int meshes() const { return meshes_; }

    // Loads the next gearbox, with newly generated noise or with the given noise. `gearbox` must
    // outlive all calls of at() for it.
    void load(const LaneSignals& gearbox, const Realization& realization);
    void load(const LaneSignals& gearbox, const InstanceInputs& inputs, RealizationNoise noise);
    // Signals of the loaded gearbox at a noise level; valid until the next call.
    features::FeatureInput at(std::size_t level);

    // True if sensor samples of the records are used: by features, or by the stages of records.
    bool keeps_samples() const;
    const LaneSignals& record() const { return *gearbox_; }  // loaded last
    const RealizationNoise& noise() const { return noise_; }
    // Importance weight of the record loaded last; 1 without importance sampling.
    double noise_weight() const;
    // Seconds spent so far on generating noise.
    double noise_s() const { return noise_s_; }

  private:
    // Prepares for signals of this many turns; 0 for those of the constructor.
    void set_turns(int turns);
    // True if any noise level adds noise to the sensor.
    bool has_sensor_noise(const InstanceInputs& inputs) const;
    void draw_sensor_noise(const LaneSignals& gearbox, const Realization& realization);
    // Tilts the noise exponentially. The kind of tilting follows from the record's number.
    void sample_sensor_noise(const LaneSignals& gearbox, const Realization& realization);
    // Generates the noise; zeros where no noise level adds any.
    void draw_noise(const LaneSignals& gearbox, const Realization& realization);
    void load_signals(const LaneSignals& gearbox, const InstanceInputs& inputs);
    // Both add the signals at one noise level, given as rms in m/s^2 and rad.
    void sensor_features(double noise, features::FeatureInput& input);
    void te_features(double noise, features::FeatureInput& input);

    const RecordPlan& plan_;
    const FeaturePlan& feature_plan_;
    const NoiseStage& noise_stage_;
    const RangeStage* const range_;  // null if samples are not clipped
    const int default_turns_;
    signals::SpanLayout span_;
    signals::SensorNoise sensor_noise_;
    signals::Windowing windowing_;
    std::optional<signals::NoiseImportanceSampler>
        sampler_;                      // importance sampling for the gearbox `sampled_gearbox_`
    GearboxId sampled_gearbox_;        // gearbox for which tilt_ was set up
    bool importance_sampled_ = false;  // true if the record loaded last has tilted noise
    signals::OrderSpectrum spectrum_;
    SpanAnalysis analysis_;
    bool needs_samples_;
    int meshes_;
    const double highest_level_;
    const LaneSignals* gearbox_ = nullptr;
    InstanceInputs inputs_{};  // of the loaded gearbox
    RealizationNoise noise_;
    std::vector<double> te_, samples_, amplitude_, tooth_rms_;
    double noise_s_ = 0.0;
};

// Change of a gearbox since its baseline: the difference between its record and the mean of its
// baseline records, sample by sample.

// Change without noise. The record and its baseline records must have equally many sensor samples.
LaneSignals change_since_baseline(const RecordPlan& plan, const LaneSignals& record,
                                  std::span<const LaneSignals* const> baselines);

// Noise of a baseline record. `rms`: that of its sensor noise divided by that of the test record.
struct BaselineNoise {
    const RealizationNoise* noise;
    double rms = 1.0;
};
// Noise of that change: the difference of the record's noise and the mean of the baselines'.
RealizationNoise noise_of_change(const RecordPlan& plan, const LaneSignals& change,
                                 const RealizationNoise& record,
                                 std::span<const BaselineNoise> baselines);

}  // namespace gearpod::mc
