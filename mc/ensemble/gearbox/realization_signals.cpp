#include "mc/ensemble/gearbox/realization_signals.hpp"

#include <algorithm>
#include <boost/random/uniform_01.hpp>
#include <cmath>

#include "machine/clocks.hpp"
#include "machine/team.hpp"
#include "mc/ensemble/gearbox/record_window.hpp"
#include "mc/ensemble/gearbox/solution_choice.hpp"
#include "mc/study/noise.hpp"
#include "mc/study/random/philox.hpp"
#include "signals/noise/normals.hpp"
#include "signals/noise/sensor_noise.hpp"
#include "signals/path/frequency_response.hpp"

namespace gearpod::mc {
namespace {

// Adds its own lifetime in seconds to a sum.
class Stopwatch {
  public:
    explicit Stopwatch(double& sum) : sum_(sum) {}
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;
    ~Stopwatch() { sum_ += seconds_since(start_); }

  private:
    double& sum_;
    const WallClock::time_point start_ = WallClock::now();
};

}  // namespace

signals::LowPassNoise low_pass_noise(const Scene& scene, const InstanceInputs& inputs) {
    return signals::LowPassNoise(inputs.low_pass_Hz * scene.record().sample_s(inputs));
}

signals::ShapedNoise background_noise(const Scene& scene, const InstanceInputs& inputs) {
    return {background_spectrum(scene.study()), inputs.low_pass_Hz,
            1.0 / scene.record().sample_s(inputs)};
}

namespace {

// True if the noise is drawn sample by sample, because it is not white.
bool generates_samples(const Scene& scene, const InstanceInputs& inputs) {
    return noise_by_density(scene.study()) || inputs.own_sampling_Hz > 0.0;
}

}  // namespace

std::vector<double> sample_noise(const Scene& scene, const Realization& realization,
                                 std::span<const double> clean, const signals::NoiseVariates& draw,
                                 int turns) {
    if (generates_samples(scene, realization.inputs)) {
        const auto normals = [&](StreamPurpose purpose) {
            return Normals::of_noise(scene.draw().seed, realization.id, purpose);
        };
        Normals filtered = normals(StreamPurpose::sensor_noise),
                white = normals(StreamPurpose::sensor_noise_direction),
                background = normals(StreamPurpose::background_noise);
        std::vector<double> unit(clean.size());
        draw_unit_noise(scene, realization.inputs,
                        NoiseEngines<Normals>{filtered, white, background}, std::span(unit));
        if (realization.inputs.own_sampling_Hz > 0.0) {
            signals::PeriodicResponse response(static_cast<int>(unit.size()));
            const double sampling_Hz = 1.0 / scene.record().sample_s(realization.inputs);
            response.add(unit, sampling_Hz, {.modes = {}, .measured = {}});
            unit = response.take(
                signals::MeasuringChain{.low_pass = {},
                                        .mounting = {},
                                        .sampling_Hz = realization.inputs.own_sampling_Hz},
                sampling_Hz);
        }
        return unit;
    }
    // Each gearbox has one stream for sensor noise, one for encoder noise, and this one. It gives
    // the directions that expand folded sensor noise to individual samples.
    Normals engine =
        Normals::of_noise(scene.draw().seed, realization.id, StreamPurpose::sensor_noise_direction);
    const std::size_t bins = draw.along.size();
    const std::size_t span = bins * static_cast<std::size_t>(turns);
    std::vector<double> unit = signals::unit_noise(clean.first(span), bins, draw, engine);
    unit.resize(clean.size());
    signals::draw_normals(engine, std::span(unit).subspan(span));
    return unit;
}

void add_noise(std::span<const double> unit, double sigma, std::span<double> samples) {
    for (std::size_t i = 0; i < samples.size(); ++i) {
        samples[i] += sigma * unit[i];
    }
}

void clip(const InstanceInputs& inputs, std::span<double> samples) {
    for (double& sample : samples) {
        sample = std::clamp(sample, -inputs.range_m_s2, inputs.range_m_s2);
    }
}

RealizationSignals::RealizationSignals(const Scene& scene, features::SignalSet needs)
    : RealizationSignals(scene, needs, scene.span().ring_teeth) {}

RealizationSignals::RealizationSignals(const Scene& scene, features::SignalSet needs, int turns)
    : scene_(scene),
      default_turns_(turns),
      span_{scene.span().planet_teeth, turns, scene.span().carrier_meshes},
      sensor_noise_(turns),
      windowing_(span_, scene.samples_per_mesh(), scene.features().tukey_taper),
      spectrum_(scene.span().planet_teeth * scene.te_samples_per_mesh()),
      analysis_(scene.record(), scene.features(), needs),
      needs_samples_(needs_samples(needs)),
      meshes_(needed_sensor_meshes(scene, needs)),
      highest_level_(std::ranges::max(scene.study().sensor.noise_levels)),
      amplitude_(static_cast<std::size_t>(spectrum_.orders())),
      tooth_rms_(static_cast<std::size_t>(scene.span().planet_teeth)) {}

bool RealizationSignals::keeps_samples() const {
    return needs_samples_ || noise_by_density(scene_.study()) || has_range(scene_.study()) ||
           has_own_rate(scene_.study());
}

void RealizationSignals::set_turns(int turns) {
    const int needed = turns > 0 ? turns : default_turns_;
    if (needed != span_.ring_teeth) {
        span_.ring_teeth = needed;
        sensor_noise_ = signals::SensorNoise(needed);
        windowing_ =
            signals::Windowing(span_, scene_.samples_per_mesh(), scene_.features().tukey_taper);
    }
}

bool RealizationSignals::has_sensor_noise(const InstanceInputs& inputs) const {
    return highest_level_ * inputs.noise_m_s2 > 0.0;
}

void RealizationSignals::draw_sensor_noise(const LaneSignals& gearbox,
                                           const Realization& realization) {
    const GearboxId& id = realization.id;
    const std::size_t bins = gearbox.folded.size();
    const bool by_samples = generates_samples(scene_, realization.inputs);
    if (!by_samples) {
        Normals engine = Normals::of_noise(scene_.draw().seed, id, StreamPurpose::sensor_noise);
        sensor_noise_.draw(engine, bins, noise_.sensor);
        if (id.noise_sampling != NoiseSampling::plain) {
            sample_sensor_noise(gearbox, realization);
        }
    }
    noise_.samples.clear();
    if (!gearbox.sensor.empty() && (needs_samples_ || by_samples || has_range(scene_.study()))) {
        noise_.samples =
            sample_noise(scene_, realization, gearbox.sensor, noise_.sensor, span_.ring_teeth);
    }
    if (by_samples) {
        const std::size_t span = bins * static_cast<std::size_t>(span_.ring_teeth);
        noise_.sensor = signals::noise_variates_of_samples(
            std::span(gearbox.sensor).first(span), std::span(noise_.samples).first(span), bins);
    }
}

void RealizationSignals::sample_sensor_noise(const LaneSignals& gearbox,
                                             const Realization& realization) {
    const GearboxId& id = realization.id;
    // Records of a gearbox have the same signals without noise unless they were cut from them.
    const auto same = [&](const GearboxId& other) {
        return other.group == id.group && other.index == id.index &&
               other.noise_sampling == id.noise_sampling && gearbox.turns == 0;
    };
    if (!sampler_ || !same(sampled_gearbox_)) {
        std::vector<double> sigmas;
        for (const double level : scene_.study().sensor.noise_levels) {
            sigmas.push_back(level * realization.inputs.noise_m_s2);
        }
        sampler_.emplace(span_, scene_.samples_per_mesh(), scene_.features().tukey_taper);
        sampler_->load(gearbox.folded, sigmas,
                       id.noise_sampling == NoiseSampling::towards_alarms
                           ? signals::NoiseImportanceSampler::TargetTail::loud
                           : signals::NoiseImportanceSampler::TargetTail::quiet);
        sampled_gearbox_ = id;
    }
    Philox engine = noise_stream(scene_.draw().seed, id, StreamPurpose::sensor_noise_kind);
    const double pick = boost::random::uniform_01<double>()(engine);
    sampler_->sample(id.repeat % signals::NoiseImportanceSampler::kKinds, pick, noise_.sensor);
    importance_sampled_ = true;
}

double RealizationSignals::noise_weight() const {
    return importance_sampled_ ? sampler_->weight(noise_.sensor) : 1.0;
}

void RealizationSignals::draw_noise(const LaneSignals& gearbox, const Realization& realization) {
    const InstanceInputs& inputs = realization.inputs;
    const Stopwatch watch(noise_s_);
    importance_sampled_ = false;
    const std::size_t bins = gearbox.folded.size();
    if (bins > 0 && has_sensor_noise(inputs)) {
        draw_sensor_noise(gearbox, realization);
    } else {
        noise_.sensor.along.assign(bins, 0.0);
        noise_.sensor.across.assign(bins, 0.0);
        noise_.samples.assign(gearbox.sensor.size(), 0.0);
    }
    noise_.encoder.assign(gearbox.te_turn.size(), 0.0);
    if (highest_level_ * inputs.encoder_noise_rad > 0.0) {
        Normals encoder =
            Normals::of_noise(scene_.draw().seed, realization.id, StreamPurpose::encoder_noise);
        signals::draw_encoder_noise(encoder, span_.ring_teeth, noise_.encoder);
    }
}

void RealizationSignals::load(const LaneSignals& gearbox, const Realization& realization) {
    set_turns(gearbox.turns);
    draw_noise(gearbox, realization);
    load_signals(gearbox, realization.inputs);
}

void RealizationSignals::load(const LaneSignals& gearbox, const InstanceInputs& inputs,
                              RealizationNoise noise) {
    set_turns(gearbox.turns);
    noise_ = std::move(noise);
    load_signals(gearbox, inputs);
}

void RealizationSignals::load_signals(const LaneSignals& gearbox, const InstanceInputs& inputs) {
    gearbox_ = &gearbox;
    inputs_ = inputs;
    if (gearbox.folded.empty()) {
        // A quasi-static gearbox has no sensor.
    } else if (has_sensor_noise(inputs)) {
        windowing_.load(gearbox.folded, noise_.sensor);
    } else {
        windowing_.load(gearbox.folded);
    }
    spectrum_.load(gearbox.te_turn, noise_.encoder);
}

void RealizationSignals::sensor_features(double noise, features::FeatureInput& input) {
    const bool clips = std::isfinite(inputs_.range_m_s2);
    if (needs_samples_ || clips) {
        samples_ = gearbox_->sensor;
        add_noise(noise_.samples, noise, samples_);
    }
    if (clips) {
        clip(inputs_, samples_);
        windowing_.load(folded_squares(scene_.record(), *gearbox_, samples_));
    }
    const double folded_noise = clips ? 0.0 : noise;  // of squares that do not contain it
    const int offset = windowing_.search(folded_noise, tooth_rms_);
    input.get<features::ToothRms<Member::planet>>() = {tooth_rms_};
    input.get<features::SensorPower>() = {windowing_.mean_square(folded_noise)};
    if (needs_samples_) {
        analysis_.sensor(samples_, span_.ring_teeth, offset, input);
    }
}

void RealizationSignals::te_features(double noise, features::FeatureInput& input) {
    te_.resize(gearbox_->te_turn.size());
    for (std::size_t i = 0; i < te_.size(); ++i) {
        te_[i] = gearbox_->te_turn[i] + noise * noise_.encoder[i];
    }
    spectrum_.amplitudes(noise, amplitude_);
    input.get<features::TeTurn>() = {te_, amplitude_, span_.planet_teeth,
                                     scene_.features().te_harmonics};
    analysis_.te(te_, input);
}

features::FeatureInput RealizationSignals::at(std::size_t level) {
    machine::throw_if_cancelled();
    const double factor = scene_.study().sensor.noise_levels[level];
    features::FeatureInput input;
    if (!gearbox_->folded.empty()) {
        sensor_features(factor * inputs_.noise_m_s2, input);
    }
    te_features(factor * inputs_.encoder_noise_rad, input);
    return input;
}

namespace {

// Subtracts `factor` times the values of b.
void subtract(std::span<const double> b, double factor, std::vector<double>& a) {
    std::transform(a.begin(), a.end(), b.begin(), a.begin(),
                   [&](double x, double y) { return x - factor * y; });
}

}  // namespace

LaneSignals change_since_baseline(const Scene& scene, const LaneSignals& record,
                                  std::span<const LaneSignals* const> baselines) {
    LaneSignals change;
    change.te_turn = record.te_turn;
    change.sensor = record.sensor;
    change.turns = record.turns;
    const double share = 1.0 / static_cast<double>(baselines.size());
    for (const LaneSignals* baseline : baselines) {
        subtract(baseline->te_turn, share, change.te_turn);
        subtract(baseline->sensor, share, change.sensor);
    }
    fold_again(scene.record(), change);
    return change;
}

RealizationNoise noise_of_change(const Scene& scene, const LaneSignals& change,
                                 const RealizationNoise& record,
                                 std::span<const BaselineNoise> baselines) {
    RealizationNoise noise;
    noise.samples = record.samples;
    noise.encoder = record.encoder;
    const double share = 1.0 / static_cast<double>(baselines.size());
    for (const BaselineNoise& one : baselines) {
        subtract(one.noise->samples, share * one.rms, noise.samples);
        subtract(one.noise->encoder, share, noise.encoder);
    }
    noise.sensor = signals::noise_variates_of_samples(
        folded_part(scene.record(), change, change.sensor),
        folded_part(scene.record(), change, noise.samples), scene.record().turn_samples());
    return noise;
}

}  // namespace gearpod::mc
