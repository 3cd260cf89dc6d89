#include "mc/ensemble/gearbox/realization_signals.hpp"

#include <boost/random/uniform_01.hpp>

#include "machine/clocks.hpp"
#include "machine/team.hpp"
#include "mc/ensemble/gearbox/record_window.hpp"
#include "mc/study/random/philox.hpp"
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

void subtract(std::span<const double> b, double factor, std::vector<double>& a) {
    std::transform(a.begin(), a.end(), b.begin(), a.begin(),
                   [&](double x, double y) { return x - factor * y; });
}

}  // namespace

std::vector<double> sample_noise(const RecordPlan& plan, const NoiseStage& stage,
                                 const Realization& realization, std::span<const double> clean,
                                 const signals::NoiseVariates& draw, int turns) {
    const auto normals = [&](StreamPurpose purpose) {
        return Normals::of_noise(plan.seed, realization.id, purpose);
    };
    if (stage.by_samples()) {
        Normals filtered = normals(StreamPurpose::sensor_noise),
                white = normals(StreamPurpose::sensor_noise_direction),
                background = normals(StreamPurpose::background_noise);
        const double sample_s = plan.sample_s(realization.inputs);
        std::vector<double> unit(clean.size());
        draw_unit_noise(stage, noise_of(realization.inputs), sample_s,
                        NoiseEngines<Normals>{filtered, white, background}, std::span(unit));
        if (stage.sampling_Hz) {
            signals::PeriodicResponse response(static_cast<int>(unit.size()));
            const double sampling_Hz = 1.0 / sample_s;
            response.add(unit, sampling_Hz, {.modes = {}, .measured = {}});
            unit = response.take(
                signals::MeasuringChain{
                    .low_pass = {}, .mounting = {}, .sampling_Hz = stage.sampling_Hz},
                sampling_Hz);
        }
        return unit;
    }
    // Each gearbox has one stream for sensor noise, one for encoder noise, and this one. It gives
    // the directions that expand folded sensor noise to individual samples.
    Normals engine = normals(StreamPurpose::sensor_noise_direction);
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

RealizationSignals::RealizationSignals(const RecordPlan& plan, const FeaturePlan& features,
                                       const SensorPlan& sensor, features::SignalSet needs,
                                       int turns)
    : plan_(plan),
      feature_plan_(features),
      noise_stage_(sensor.noise()),
      range_(sensor.find<RangeStage>()),
      default_turns_(turns > 0 ? turns : plan.span.ring_teeth),
      span_{plan.span.planet_teeth, default_turns_, plan.span.carrier_meshes},
      sensor_noise_(default_turns_),
      windowing_(span_, plan.samples, features.tukey_taper),
      spectrum_(plan.span.planet_teeth * plan.te_samples),
      analysis_(plan, features, needs),
      needs_samples_(needs_samples(needs)),
      meshes_(plan.sensor_meshes(needs)),
      highest_level_(std::ranges::max(plan.noise_levels)),
      amplitude_(static_cast<std::size_t>(spectrum_.orders())),
      tooth_rms_(static_cast<std::size_t>(plan.span.planet_teeth)) {}

bool RealizationSignals::keeps_samples() const {
    return needs_samples_ || noise_stage_.by_samples() || range_ != nullptr;
}

void RealizationSignals::set_turns(int turns) {
    const int needed = turns > 0 ? turns : default_turns_;
    if (needed != span_.ring_teeth) {
        span_.ring_teeth = needed;
        sensor_noise_ = signals::SensorNoise(needed);
        windowing_ = signals::Windowing(span_, plan_.samples, feature_plan_.tukey_taper);
    }
}

bool RealizationSignals::has_sensor_noise(const InstanceInputs& inputs) const {
    return highest_level_ * inputs.noise_m_s2 > 0.0;
}

void RealizationSignals::draw_sensor_noise(const LaneSignals& gearbox,
                                           const Realization& realization) {
    const GearboxId& id = realization.id;
    const std::size_t bins = gearbox.folded.size();
    const bool by_samples = noise_stage_.by_samples();
    if (!by_samples) {
        Normals engine = Normals::of_noise(plan_.seed, id, StreamPurpose::sensor_noise);
        sensor_noise_.draw(engine, bins, noise_.sensor);
        if (id.noise_sampling != NoiseSampling::plain) {
            sample_sensor_noise(gearbox, realization);
        }
    }
    noise_.samples.clear();
    if (!gearbox.sensor.empty() && keeps_samples()) {
        noise_.samples = sample_noise(plan_, noise_stage_, realization, gearbox.sensor,
                                      noise_.sensor, span_.ring_teeth);
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
        for (const double level : plan_.noise_levels) {
            sigmas.push_back(level * realization.inputs.noise_m_s2);
        }
        sampler_.emplace(span_, plan_.samples, feature_plan_.tukey_taper);
        sampler_->load(gearbox.folded, sigmas,
                       id.noise_sampling == NoiseSampling::towards_alarms
                           ? signals::NoiseImportanceSampler::TargetTail::loud
                           : signals::NoiseImportanceSampler::TargetTail::quiet);
        sampled_gearbox_ = id;
    }
    Philox engine = noise_stream(plan_.seed, id, StreamPurpose::sensor_noise_kind);
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
            Normals::of_noise(plan_.seed, realization.id, StreamPurpose::encoder_noise);
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
    if (needs_samples_ || range_ != nullptr) {
        samples_ = gearbox_->sensor;
        add_noise(noise_.samples, noise, samples_);
    }
    if (range_ != nullptr) {
        range_->clip(samples_);
        windowing_.load(folded_squares(plan_, *gearbox_, samples_));
    }
    // Clipped squares contain their noise already.
    const double folded_noise = range_ != nullptr ? 0.0 : noise;
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
                                     feature_plan_.te_harmonics};
    analysis_.te(te_, input);
}

features::FeatureInput RealizationSignals::at(std::size_t level) {
    machine::throw_if_cancelled();
    const double factor = plan_.noise_levels[level];
    features::FeatureInput input;
    if (!gearbox_->folded.empty()) {
        sensor_features(factor * inputs_.noise_m_s2, input);
    }
    te_features(factor * inputs_.encoder_noise_rad, input);
    return input;
}

LaneSignals change_since_baseline(const RecordPlan& plan, const LaneSignals& record,
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
    fold_again(plan, change);
    return change;
}

RealizationNoise noise_of_change(const RecordPlan& plan, const LaneSignals& change,
                                 const RealizationNoise& record,
                                 std::span<const BaselineNoise> baselines) {
    RealizationNoise noise;
    noise.samples = record.samples;
    noise.encoder = record.encoder;
    const double share = 1.0 / static_cast<double>(baselines.size());
    for (const BaselineNoise& baseline : baselines) {
        subtract(baseline.noise->samples, share * baseline.rms, noise.samples);
        subtract(baseline.noise->encoder, share, noise.encoder);
    }
    noise.sensor = signals::noise_variates_of_samples(folded_part(plan, change, change.sensor),
                                                      folded_part(plan, change, noise.samples),
                                                      plan.turn_samples());
    return noise;
}

}  // namespace gearpod::mc
