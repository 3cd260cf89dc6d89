// features SIGNAL --study STUDY: a study's features of a measured signal.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "mc/commands/support.hpp"
#include "mc/files/json_text.hpp"
#include "mc/files/signal_file.hpp"
#include "mc/gearbox/measured_features.hpp"

namespace gearpod::mc {
namespace {

void print_text(const std::vector<MeasuredFeature>& all, const MeasuredSignal& signal,
                const Scene& scene) {
    fmt::print("mesh phase: {}\n", signal.tracking);
    fmt::print("{} mesh periods of sensor signal, {} of transmission error; the span is {}\n",
               signal.sensor_meshes, signal.te_meshes, scene.span_meshes());
    if (const int turns = planet_turns(signal, scene);
        turns > 0 && turns < scene.span().ring_teeth) {
        fmt::print("the planets' teeth over {} of the span's {} planet turns\n", turns,
                   scene.span().ring_teeth);
    }
    for (const MeasuredFeature& one : all) {
        if (one.missing.empty()) {
            fmt::print("{:<22}{:>14.8g}  {}\n", one.feature->name, one.value,
                       one.feature->unit == "1" ? "" : one.feature->unit);
        }
    }
    for (const MeasuredFeature& one : all) {
        if (!one.missing.empty()) {
            fmt::print("{:<22}{:>14}  {}\n", one.feature->name, "-", one.missing);
        }
    }
}

std::string measured_json(const std::vector<MeasuredFeature>& all, const MeasuredSignal& signal,
                          const Scene& scene) {
    nlohmann::ordered_json json;
    json["mesh_phase"] = signal.tracking;
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
    return json_text(json, 2) + "\n";
}

// Says so if no feature can be had, and what the shortest takes.
bool any_feature(const std::vector<MeasuredFeature>& all, const std::string& path,
                 const Scene& scene, const MeasuredSignal& signal) {
    const auto good = [](const MeasuredFeature& one) { return one.missing.empty(); };
    if (std::any_of(all.begin(), all.end(), good)) {
        return true;
    }
    int shortest = 0;
    for (const MeasuredFeature& one : all) {
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
        const auto all = measure(*scene, signal, healthy);
        if (!any_feature(all, options.signals.front(), *scene, signal)) {
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
