// Command `features SIGNAL --study STUDY`: features of one measured signal.
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <nlohmann/json.hpp>

#include "mc/commands/commands.hpp"
#include "mc/files/json_text.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/gearbox/measured_features.hpp"
#include "mc/input/exception_text.hpp"
#include "mc/input/wrapped_text.hpp"
#include "mc/recordings/population.hpp"
#include "mc/run/support.hpp"

namespace gearpod::mc {
namespace {

constexpr std::size_t kMissingColumn = 38;  // of the reasons why features are missing

void print_text(const Measurement& measured, const MeasuredSignal& signal, const Scene& scene) {
    const std::vector<MeasuredFeature>& all = measured.features;
    fmt::print("{}\n", wrapped_text("mesh phase: " + signal.tracking, 2));
    fmt::print("mesh periods: {} of acceleration, {} of transmission error (full span: {})\n",
               signal.sensor_meshes, signal.te_meshes, scene.span_meshes());
    if (const int turns = planet_turns(signal, scene);
        turns > 0 && turns < scene.span().ring_teeth) {
        fmt::print("planet turns: {} (full span: {})\n", turns, scene.span().ring_teeth);
    }
    if (measured.change) {
        fmt::print(
            "baseline: {} planet turns, shifted by {:.2f} mesh periods; correlation {:.3f}\n",
            planet_turns(measured.change->signal, scene), measured.change->meshes,
            measured.change->correlation);
    }
    if (!signal.losses_detectable) {
        fmt::print(
            "lost samples cannot be detected: that needs six similar turns of the carrier or\n"
            "wheel\n");
    }
    for (const MeasuredFeature& one : all) {
        if (one.missing.empty()) {
            fmt::print("{:<22}{:>14.8g}  {}\n", one.feature->name, one.value,
                       one.feature->unit == "1" ? "" : one.feature->unit);
        }
    }
    for (const MeasuredFeature& one : all) {
        if (!one.missing.empty()) {
            fmt::print("{:<22}{:>14}  {}\n", one.feature->name, "-",
                       wrapped_text(one.missing, kMissingColumn));
        }
    }
}

nlohmann::ordered_json measured_json(const std::vector<MeasuredFeature>& all,
                                     const MeasuredSignal& signal, const Scene& scene) {
    nlohmann::ordered_json json;
    json["mesh_phase"] = signal.tracking;
    json["losses_noticed"] = signal.losses_detectable;
    json["sensor_meshes"] = signal.sensor_meshes;
    json["te_meshes"] = signal.te_meshes;
    json["span_meshes"] = scene.span_meshes();
    json["planet_turns"] = planet_turns(signal, scene);
    json["features"] = nlohmann::ordered_json::object();
    json["unavailable"] = nlohmann::ordered_json::object();
    for (const MeasuredFeature& one : all) {
        const std::string name(one.feature->name);
        if (!one.missing.empty()) {
            json["unavailable"][name] = one.missing;
        } else {
            json["features"][name] = one.value;
        }
    }
    return json;
}

// Tests the features against the healthy gearboxes of --against. Returns the text and adds the
// result to the JSON.
std::string compare(const FeaturesOptions& options, const Measurement& measured,
                    const MeasuredSignal& signal, const Scene& scene,
                    nlohmann::ordered_json& json) {
    const Population population =
        read_population(options.against, options.noise_level, scene.study());
    const auto verdicts =
        compare_with_population(population, values_of(measured.features), options.feature);
    const std::string sentence =
        verdict_sentence(options.signals.front(), population, verdicts.front(), measured.teeth);
    std::string text = fmt::format("\n{:<22}{:>13}{:>13}{:>8}{:>24}\n", "feature", "value",
                                   "threshold", "", "healthy less extreme");
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Verdict& one : verdicts) {
        const auto healthy = static_cast<double>(one.population->healthy.size());
        text += fmt::format("{:<22}{:>13.6g}{:>13.6g}{:>8}{:>14} of {}\n", one.population->name,
                            one.value, one.population->threshold, one.alarm ? "ALARM" : "",
                            one.less_extreme, one.population->healthy.size());
        list.push_back({{"feature", one.population->name},
                        {"value", one.value},
                        {"threshold", one.population->threshold},
                        {"alarm", one.alarm},
                        {"margin", one.margin},
                        {"quantile", static_cast<double>(one.less_extreme) / healthy},
                        {"healthy", one.population->healthy.size()}});
    }
    text += "\n" + wrapped_text(sentence, 0) + "\n";
    const int turns = planet_turns(signal, scene);
    if (!population.recordings && turns < scene.span().ring_teeth && signal.has_sensor) {
        text += wrapped_text(
                    fmt::format("The simulated gearboxes have {} planet turns, the recording has "
                                "{}: it averages less, so its features scatter more.",
                                scene.span().ring_teeth, turns),
                    0) +
                "\n";
    }
    nlohmann::ordered_json teeth = nlohmann::ordered_json::array();
    for (const WorstTooth& tooth : measured.teeth) {
        teeth.push_back({{"gear", tooth.gear},
                         {"tooth", tooth.tooth},
                         {"teeth", tooth.teeth},
                         {"ratio", tooth.ratio}});
    }
    json["against"] = {{"file", options.against},
                       {"alarm", verdicts.front().alarm},
                       {"feature", verdicts.front().population->name},
                       {"sentence", sentence},
                       {"features", list},
                       {"teeth", teeth}};
    return text;
}

// Returns false and prints the reason if no feature could be computed; a signal that is too short
// is reported with the smallest number of mesh periods needed.
bool check_any_feature(const std::vector<MeasuredFeature>& all, const std::string& path,
                       const Scene& scene, const MeasuredSignal& signal) {
    const auto good = [](const MeasuredFeature& one) { return one.missing.empty(); };
    if (std::any_of(all.begin(), all.end(), good)) {
        return true;
    }
    int shortest = 0;
    for (const MeasuredFeature& one : all) {
        const bool there = (one.feature->from_sensor ? signal.has_sensor : signal.has_te) &&
                           !(one.feature->from_sensor && scene.study().effects.quasi_static());
        const bool central = one.feature->needs.overlaps(features::kCentralGears);
        const int needed = central ? 0 : meshes_of(*one.feature, scene);
        const int has = one.feature->from_sensor ? signal.sensor_meshes : signal.te_meshes;
        if (there && has < needed) {
            shortest = shortest == 0 ? needed : std::min(shortest, needed);
        }
    }
    if (shortest == 0) {
        fmt::print(stderr, "{}: no feature can be computed: {}\n", path, all.front().missing);
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
    if (options.against.empty() && !options.feature.empty()) {
        fmt::print(stderr, "--feature {}: is only used with --against\n", options.feature);
        return kBadInput;
    }
    const bool many = options.signals.size() != 1 || !options.manifest.empty() ||
                      !options.out.empty() || !options.csv.empty();
    if (many) {
        return recordings_command(options);
    }
    std::vector<FileRole> read{{"the study", options.study.path},
                               {"the signal", options.signals.front()}};
    for (const std::string& path : options.healthy) {
        read.push_back({"a recording of --healthy", path});
    }
    read.push_back({"the file of --against", options.against});
    read.push_back({"the recording of --baseline", options.baseline});
    const bool writable = can_write({"--json", options.json}, read);
    const auto scene = load_scene(options.study).scene;
    if (!scene || !writable) {
        return kBadInput;
    }
    try {
        const MeasuredSignal signal =
            read_measured_signal(options.signals.front(), options.columns, *scene);
        const bool long_enough =
            !signal.sensor.empty() && signal.sensor_meshes >= scene->span_meshes();
        HealthyReference healthy;
        if (!options.healthy.empty()) {
            healthy = measured_reference(options.healthy, options.columns, *scene,
                                         planet_turns(signal, *scene));
        } else if (long_enough) {
            healthy = simulated_reference_at(options.noise_level, *scene);
        }
        const auto baseline = measured_baseline(options.baseline, options.columns, *scene);
        const Measurement measured =
            measure(*scene, signal, healthy, baseline ? &*baseline : nullptr);
        const auto& all = measured.features;
        if (!check_any_feature(all, options.signals.front(), *scene, signal)) {
            return kBadInput;
        }
        nlohmann::ordered_json json = measured_json(all, signal, *scene);
        if (measured.change) {
            json["baseline"] = {{"file", options.baseline},
                                {"turned_on_meshes", measured.change->meshes},
                                {"correlation", measured.change->correlation},
                                {"planet_turns", planet_turns(measured.change->signal, *scene)}};
        }
        std::string verdict;
        if (!options.against.empty()) {
            verdict = compare(options, measured, signal, *scene, json);
        }
        if (options.json.empty()) {
            print_text(measured, signal, *scene);
            fmt::print("{}", verdict);
            return kDone;
        }
        return write_text_to(options.json, json_text(json, 2) + "\n") ? kDone : kBadInput;
    } catch (const SignalError& error) {
        fmt::print(stderr, "{}\n", error.what());
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", exception_text(error));
    }
    return kBadInput;
}

}  // namespace gearpod::mc
