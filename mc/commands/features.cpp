// features SIGNAL --study STUDY: a study's features of a measured signal.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "mc/commands/support.hpp"
#include "mc/files/json_text.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/gearbox/healthy_reference.hpp"
#include "mc/gearbox/instance_features.hpp"
#include "mc/gearbox/measured_signal.hpp"
#include "mc/gearbox/span_analysis.hpp"
#include "mc/scene/feature_needs.hpp"
#include "signals/spectra/order_spectrum.hpp"
#include "signals/spectra/synchronous_average.hpp"
#include "signals/windowing/folded_signal.hpp"
#include "signals/windowing/windowing.hpp"

namespace gearpod::mc {
namespace {

using features::Feature;

constexpr int kFewestOfParts = 4;  // samples a mesh period that can be parted (mesh_separation.hpp)

// Mesh periods of its signal that a feature looks at.
int meshes_of(const Feature& feature, const Scene& scene) {
    return feature.from_sensor ? meshes_needed(scene.study(), scene.span(), feature.needs)
                               : scene.span().planet_teeth;
}

// Why a feature cannot be had of this signal; "" if it can.
std::string missing(const Feature& feature, const Scene& scene, const MeasuredSignal& signal,
                    bool has_reference) {
    const bool planetary = scene.study().gearbox.kind == GearboxKind::planetary;
    if ((feature.needs & (features::kSun | features::kRing)) != 0 && !planetary) {
        return "the gearbox has no sun and no ring";
    }
    if (feature.from_sensor && scene.study().effects.quasi_static()) {
        return "the study has no sensor (effects.motion)";
    }
    if (!(feature.from_sensor ? signal.has_sensor : signal.has_te)) {
        return feature.from_sensor ? "no sensor signal" : "no transmission error";
    }
    const int has = feature.from_sensor ? signal.sensor_meshes : signal.te_meshes;
    const int needed = meshes_of(feature, scene);
    if (has < needed) {
        return fmt::format("{} mesh periods, but it takes {}", has, needed);
    }
    if ((feature.needs & features::kTeParts) != 0 && scene.te_samples_per_mesh() < kFewestOfParts) {
        return fmt::format("the study's encoders sample {} times a mesh period, but it takes {}",
                           scene.te_samples_per_mesh(), kFewestOfParts);
    }
    if ((feature.needs & features::kHealthy) != 0 && !has_reference) {
        return "no healthy gearboxes at that noise level to compare with: give --healthy or "
               "--noise-level";
    }
    return "";
}

// The signals of a recording as features look at them.
class MeasuredInput {
  public:
    MeasuredInput(const Scene& scene, unsigned needs) : scene_(scene), analysis_(scene, needs) {}

    features::FeatureInput of(const MeasuredSignal& signal) {
        features::FeatureInput input;
        input.planet_teeth = scene_.span().planet_teeth;
        input.te_harmonics = scene_.study().features.te_harmonics;
        if (signal.te_meshes >= scene_.span().planet_teeth) {
            add_te(signal, input);
        }
        if (signal.sensor_meshes >= scene_.span_meshes()) {
            add_sensor(signal, input);
        }
        return input;
    }

  private:
    // Over as many planet turns as there are, at most those of the span.
    void add_te(const MeasuredSignal& signal, features::FeatureInput& input) {
        const std::size_t turn = static_cast<std::size_t>(scene_.span().planet_teeth) *
                                 static_cast<std::size_t>(scene_.te_samples_per_mesh());
        const std::size_t span = turn * static_cast<std::size_t>(scene_.span().ring_teeth);
        te_ = signals::synchronous_average(
            std::span(signal.te).first(std::min(signal.te.size(), span)), turn);
        double sum = 0.0, largest = 0.0, deviation = 0.0;
        for (const double value : te_) {
            sum += value;
            largest = std::max(largest, std::abs(value));
        }
        for (double& value : te_) {
            value -= sum / static_cast<double>(turn);
            deviation = std::max(deviation, std::abs(value));
        }
        // What then is left is rounding, whose ratios say nothing.
        if (deviation <= kRounding * largest) {
            std::fill(te_.begin(), te_.end(), 0.0);
        }
        signals::OrderSpectrum spectrum(static_cast<int>(turn));
        spectrum.load(te_);
        amplitude_.resize(static_cast<std::size_t>(spectrum.orders()));
        spectrum.amplitudes(0.0, amplitude_);
        input.te_turn = te_;
        input.te_amplitude = amplitude_;
        analysis_.te(te_, input);
    }

    void add_sensor(const MeasuredSignal& signal, features::FeatureInput& input) {
        const int phases = scene_.samples_per_mesh();
        const auto meshes = [&](int count) {
            return static_cast<std::size_t>(count) * static_cast<std::size_t>(phases);
        };
        const auto folded =
            signals::fold_of_squares(std::span(signal.sensor).first(meshes(scene_.span_meshes())),
                                     meshes(scene_.span().planet_teeth));
        signals::Windowing windowing(scene_.span(), phases, scene_.study().features.tukey_taper);
        tooth_rms_.resize(static_cast<std::size_t>(scene_.span().planet_teeth));
        windowing.load(folded);
        const int offset = windowing.search(0.0, tooth_rms_);
        input.tooth_rms = tooth_rms_;
        input.sensor_mean_square = windowing.mean_square(0.0);
        analysis_.sensor(signal.sensor, offset, input);
    }

    static constexpr double kRounding = 1e-13;

    const Scene& scene_;
    SpanAnalysis analysis_;
    std::vector<double> te_, amplitude_, tooth_rms_;
};

// Of recordings of healthy gearboxes.
HealthyReference measured_reference(const FeaturesOptions& options, const Scene& scene) {
    HealthyRecordsMean mean(1);
    for (const std::string& path : options.healthy) {
        const MeasuredSignal signal = read_measured_signal(path, options.columns, scene);
        if (signal.sensor_meshes < scene.span_meshes()) {
            throw SignalError(
                fmt::format("{}: {} mesh periods of sensor signal, but a healthy "
                            "record must have {}",
                            path, signal.sensor_meshes, scene.span_meshes()));
        }
        MeasuredInput input(scene, features::kSensorTurn);
        mean.add(0, input.of(signal));
    }
    return mean.mean();
}

// The simulated one at the noise level that the options name; empty if the study lacks it.
HealthyReference simulated_at(double noise_level, const Scene& scene) {
    const auto& levels = scene.study().sensor.noise_levels;
    const auto level = std::find(levels.begin(), levels.end(), noise_level);
    if (level == levels.end() || scene.study().effects.quasi_static()) {
        return {};
    }
    const auto at = static_cast<std::size_t>(level - levels.begin());
    const HealthyReference all =
        simulated_reference(scene, Sampler(scene.study()), path_grid(scene));
    return {{all.residual_variance[at]}, {all.envelope_variance[at]}, {all.amplitude[at]}};
}

// Why a feature has no number although its signal is there.
std::string why_no_value(const Feature& feature, const features::FeatureInput& input,
                         const Scene& scene) {
    const auto zero = [](std::span<const double> values) {
        return std::all_of(values.begin(), values.end(), [](double v) { return v == 0.0; });
    };
    if (!feature.from_sensor && zero(input.te_turn)) {
        return "the transmission error is constant";
    }
    if (feature.compute == features::te_fm0 && scene.te_samples_per_mesh() <= 2) {
        return fmt::format("no mesh harmonic: the study's encoders sample {} times a mesh period",
                           scene.te_samples_per_mesh());
    }
    if (feature.from_sensor && input.sensor_mean_square == 0.0) {
        return "the sensor's signal is zero";
    }
    return "no finite number: its definition divides by what is zero in this signal";
}

struct Measured {
    const Feature* feature;
    double value;
    std::string missing;
};

std::vector<Measured> measure(const Scene& scene, const MeasuredSignal& signal,
                              const HealthyReference& healthy) {
    std::vector<Measured> all;
    unsigned needs = 0;
    for (const Feature& feature : features::all_features()) {
        if (feature.compared != features::Compared::nothing) {
            continue;  // one recording has no baseline
        }
        all.push_back({&feature, 0.0, missing(feature, scene, signal, !healthy.amplitude.empty())});
        needs |= all.back().missing.empty() ? feature.needs : 0U;
    }
    MeasuredInput measured(scene, needs);
    features::FeatureInput input = measured.of(signal);
    if (!healthy.amplitude.empty()) {
        input.healthy = healthy.at(0);
    }
    for (Measured& one : all) {
        if (one.missing.empty()) {
            one.value = one.feature->value(input);
            if (!std::isfinite(one.value)) {
                one.missing = why_no_value(*one.feature, input, scene);
            }
        }
    }
    return all;
}

void print_text(const std::vector<Measured>& all, const MeasuredSignal& signal,
                const Scene& scene) {
    fmt::print("mesh phase: {}\n", signal.tracking);
    fmt::print("{} mesh periods of sensor signal, {} of transmission error; the span is {}\n",
               signal.sensor_meshes, signal.te_meshes, scene.span_meshes());
    for (const Measured& one : all) {
        if (one.missing.empty()) {
            fmt::print("{:<22}{:>14.8g}  {}\n", one.feature->name, one.value,
                       one.feature->unit == "1" ? "" : one.feature->unit);
        }
    }
    for (const Measured& one : all) {
        if (!one.missing.empty()) {
            fmt::print("{:<22}{:>14}  {}\n", one.feature->name, "-", one.missing);
        }
    }
}

std::string measured_json(const std::vector<Measured>& all, const MeasuredSignal& signal,
                          const Scene& scene) {
    nlohmann::ordered_json json;
    json["mesh_phase"] = signal.tracking;
    json["sensor_meshes"] = signal.sensor_meshes;
    json["te_meshes"] = signal.te_meshes;
    json["span_meshes"] = scene.span_meshes();
    json["features"] = nlohmann::ordered_json::object();
    json["unavailable"] = nlohmann::ordered_json::object();
    for (const Measured& one : all) {
        const std::string name(one.feature->name);
        if (!one.missing.empty()) {
            json["unavailable"][name] = one.missing;
        } else {
            json["features"][name] = one.value;
        }
    }
    return json_text(json, 2) + "\n";
}

// Says so if no feature can be had, and what the shortest takes.
bool any_feature(const std::vector<Measured>& all, const std::string& path, const Scene& scene,
                 const MeasuredSignal& signal) {
    const auto good = [](const Measured& one) { return one.missing.empty(); };
    if (std::any_of(all.begin(), all.end(), good)) {
        return true;
    }
    int shortest = 0;
    for (const Measured& one : all) {
        const bool there = (one.feature->from_sensor ? signal.has_sensor : signal.has_te) &&
                           !(one.feature->from_sensor && scene.study().effects.quasi_static());
        const bool central = (one.feature->needs & (features::kSun | features::kRing)) != 0;
        const int needed = central ? 0 : meshes_of(*one.feature, scene);
        const int has = one.feature->from_sensor ? signal.sensor_meshes : signal.te_meshes;
        if (there && has < needed) {
            shortest = shortest == 0 ? needed : std::min(shortest, needed);
        }
    }
    if (shortest == 0) {
        fmt::print(stderr, "{}: no feature can be had of it: {}\n", path, all.front().missing);
    } else {
        fmt::print(stderr,
                   "{}: too short: {} mesh periods of sensor signal and {} of transmission "
                   "error; at least {} are needed\n",
                   path, signal.sensor_meshes, signal.te_meshes, shortest);
    }
    return false;
}

}  // namespace

int features_command(const FeaturesOptions& options) {
    std::vector<FileRole> read{{"the study", options.study.path}, {"the signal", options.signal}};
    for (const std::string& path : options.healthy) {
        read.push_back({"a recording of --healthy", path});
    }
    const bool writable = can_write({"--json", options.json}, read);
    const auto scene = load_scene(options.study).scene;
    if (!scene || !writable) {
        return kBadInput;
    }
    try {
        const MeasuredSignal signal = read_measured_signal(options.signal, options.columns, *scene);
        const bool long_enough =
            !signal.sensor.empty() && signal.sensor_meshes >= scene->span_meshes();
        HealthyReference healthy;
        if (!options.healthy.empty()) {
            healthy = measured_reference(options, *scene);
        } else if (long_enough) {
            healthy = simulated_at(options.noise_level, *scene);
        }
        const auto all = measure(*scene, signal, healthy);
        if (!any_feature(all, options.signal, *scene, signal)) {
            return kBadInput;
        }
        if (options.json.empty()) {
            print_text(all, signal, *scene);
            return kDone;
        }
        return write_text_to(options.json, measured_json(all, signal, *scene)) ? kDone : kBadInput;
    } catch (const SignalError& error) {
        fmt::print(stderr, "{}\n", error.what());
        return kBadInput;
    }
}

}  // namespace gearpod::mc
