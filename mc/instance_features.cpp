#include "mc/instance_features.hpp"

#include <chrono>
#include <stdexcept>

#include "signals/encoder_noise.hpp"
#include "signals/folded_signal.hpp"

namespace gearpod::mc {
namespace {

// Adds the time of its life to a sum.
class Stopwatch {
  public:
    explicit Stopwatch(double& sum) : sum_(sum) {}
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;
    ~Stopwatch() {
        sum_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

  private:
    double& sum_;
    const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

Philox stream(const Study& study, Group group, std::uint64_t instance, std::string_view purpose) {
    return {static_cast<std::uint64_t>(study.ensemble.seed), group, instance,
            parameter_id(purpose)};
}

}  // namespace

Philox sensor_noise_stream(const Study& study, Group group, std::uint64_t instance) {
    return stream(study, group, instance, "noise.sensor");
}

Philox encoder_noise_stream(const Study& study, Group group, std::uint64_t instance) {
    return stream(study, group, instance, "noise.encoder");
}

Philox noise_direction_stream(const Study& study, Group group, std::uint64_t instance) {
    return stream(study, group, instance, "noise.sensor.direction");
}

signals::SpanLayout span_layout(const Scene& scene) {
    return scene.span();
}

std::vector<const features::Feature*> used_features(const Study& study) {
    std::vector<const features::Feature*> used;
    for (const std::string& name : study.features.use) {
        const features::Feature* feature = features::find_feature(name);
        if (feature == nullptr) {
            throw std::invalid_argument("unknown feature " + name);
        }
        used.push_back(feature);
    }
    return used;
}

InstanceFeatures::InstanceFeatures(const Scene& scene)
    : scene_(scene),
      features_(used_features(scene.study())),
      sensor_noise_(scene.span().ring_teeth),
      windowing_(span_layout(scene), scene.samples_per_mesh(), scene.study().features.tukey_taper),
      spectrum_(scene.span().planet_teeth * scene.te_samples_per_mesh()),
      amplitude_(static_cast<std::size_t>(spectrum_.orders())),
      tooth_rms_(static_cast<std::size_t>(scene.span().planet_teeth)) {}

void InstanceFeatures::draw_noise(std::size_t bins, std::size_t te_samples, Group group,
                                  std::uint64_t instance) {
    const Stopwatch watch(noise_s_);
    if (bins > 0) {
        Philox sensor = sensor_noise_stream(scene_.study(), group, instance);
        sensor_noise_.draw(sensor, bins, noise_.sensor);
    }
    Philox encoder = encoder_noise_stream(scene_.study(), group, instance);
    noise_.encoder.resize(te_samples);
    signals::draw_encoder_noise(encoder, scene_.span().ring_teeth, noise_.encoder);
}

void InstanceFeatures::add_noise(std::span<const double> folded, double sensor_noise,
                                 std::span<const double> te_turn, double te_noise) {
    const Stopwatch watch(noise_s_);
    if (!folded.empty()) {
        signals::add_sensor_noise(folded, noise_.sensor, sensor_noise, folded_);
    }
    for (std::size_t i = 0; i < te_.size(); ++i) {
        te_[i] = te_turn[i] + te_noise * noise_.encoder[i];
    }
}

std::vector<double> InstanceFeatures::compute(std::span<const double> folded,
                                              std::span<const double> te_turn,
                                              const InstanceInputs& inputs, Group group,
                                              std::uint64_t instance,
                                              std::vector<LevelSignals>* signals) {
    const Study& study = scene_.study();
    const auto& levels = study.sensor.noise_levels;
    const bool sensed = !folded.empty();  // a quasi-static gearbox has no sensor
    draw_noise(folded.size(), te_turn.size(), group, instance);
    spectrum_.load(te_turn, noise_.encoder);
    folded_.resize(folded.size());
    te_.resize(te_turn.size());

    std::vector<double> values(features_.size() * levels.size());
    for (std::size_t level = 0; level < levels.size(); ++level) {
        const double te_noise = levels[level] * inputs.encoder_noise_rad;
        add_noise(folded, levels[level] * inputs.noise_m_s2, te_turn, te_noise);
        spectrum_.amplitudes(te_noise, amplitude_);
        features::FeatureInput input;
        if (sensed) {
            windowing_.search(folded_, tooth_rms_);
            input.sensor_mean_square = signals::mean_square(folded_, span_layout(scene_));
        }
        input.te_turn = te_;
        input.te_amplitude = amplitude_;
        input.planet_teeth = scene_.span().planet_teeth;
        input.te_harmonics = study.features.te_harmonics;
        input.tooth_rms = tooth_rms_;
        if (signals != nullptr) {
            signals->push_back({te_, sensed ? tooth_rms_ : std::vector<double>{}});
        }
        for (std::size_t f = 0; f < features_.size(); ++f) {
            values[f * levels.size() + level] = features_[f]->compute(input);
        }
    }
    return values;
}

}  // namespace gearpod::mc
