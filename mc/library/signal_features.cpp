#include "mc/library/signal_features.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace gearpod::mc {
namespace {

// Throws SignalError with the reason if no feature could be computed. Of a signal that is too short
// the message states the smallest number of mesh periods needed.
void check_any_feature(const std::vector<MeasuredFeature>& all, const std::string& name,
                       const Scene& scene, const MeasuredSignal& signal) {
    const auto good = [](const MeasuredFeature& one) { return one.missing.empty(); };
    if (std::any_of(all.begin(), all.end(), good)) {
        return;
    }
    int shortest = 0;
    for (const MeasuredFeature& one : all) {
        const bool there = (one.feature->from_sensor ? signal.has_sensor : signal.has_te) &&
                           !(one.feature->from_sensor && !scene.features().sensor);
        const bool central = one.feature->needs.overlaps(features::kCentralGears);
        const int needed = central ? 0 : scene.features().least_meshes(*one.feature);
        const int has = one.feature->from_sensor ? signal.sensor_meshes : signal.te_meshes;
        if (there && has < needed) {
            shortest = shortest == 0 ? needed : std::min(shortest, needed);
        }
    }
    if (shortest == 0) {
        throw SignalError(
            fmt::format("{}: no feature can be computed: {}", name, all.front().missing));
    }
    throw SignalError(
        fmt::format("{}: too short for every feature: {} mesh periods of sensor signal and {} of "
                    "transmission error; record at least {}",
                    name, signal.sensor_meshes, signal.te_meshes, shortest));
}

PopulationDecisions compared(const SignalRequest& request, const Measurement& measured,
                             const Scene& scene) {
    PopulationDecisions compared;
    compared.population =
        read_population(request.against, request.noise_level, scene.features().teeth);
    std::vector<const features::Feature*> features;
    for (const MeasuredFeature& one : measured.features) {
        features.push_back(one.feature);
    }
    compared.decisions = compare_with_population(compared.population, features,
                                                 values_of(measured.features), request.feature);
    compared.sentence = decision_sentence(request.signal.name, compared.population,
                                          compared.decisions.front(), measured.teeth);
    return compared;
}

nlohmann::ordered_json measured_json(const SignalFeatures& measured, const Scene& scene) {
    const MeasuredSignal& signal = measured.signal;
    nlohmann::ordered_json json;
    json["mesh_phase"] = signal.tracking;
    json["losses_noticed"] = signal.losses_detectable;
    json["notes"] = measured.notes;
    json["sensor_meshes"] = signal.sensor_meshes;
    json["te_meshes"] = signal.te_meshes;
    json["span_meshes"] = scene.span_meshes();
    json["planet_turns"] = planet_turns(signal, scene);
    json["features"] = nlohmann::ordered_json::object();
    json["unavailable"] = nlohmann::ordered_json::object();
    for (const MeasuredFeature& one : measured.measured.features) {
        const std::string name(one.feature->name);
        if (!one.missing.empty()) {
            json["unavailable"][name] = one.missing;
        } else {
            json["features"][name] = one.value;
        }
    }
    return json;
}

nlohmann::ordered_json decisions_json(const PopulationDecisions& against,
                                      const std::vector<WorstTooth>& worst,
                                      const std::string& file) {
    nlohmann::ordered_json features = nlohmann::ordered_json::array();
    for (const AlarmDecision& one : against.decisions) {
        const auto healthy = static_cast<double>(one.population->healthy.size());
        features.push_back({{"feature", one.population->name},
                            {"value", one.value},
                            {"threshold", one.population->threshold},
                            {"alarm", one.alarm},
                            {"margin", one.margin},
                            {"quantile", static_cast<double>(one.less_extreme) / healthy},
                            {"healthy", one.population->healthy.size()}});
    }
    nlohmann::ordered_json teeth = nlohmann::ordered_json::array();
    for (const WorstTooth& tooth : worst) {
        teeth.push_back({{"gear", tooth.gear},
                         {"tooth", tooth.tooth},
                         {"teeth", tooth.teeth},
                         {"ratio", tooth.ratio}});
    }
    return {{"file", file},
            {"alarm", against.decisions.front().alarm},
            {"feature", against.decisions.front().population->name},
            {"sentence", against.sentence},
            {"features", features},
            {"teeth", teeth}};
}

}  // namespace

SignalFeatures signal_features(const SignalRequest& request, const Scene& scene) {
    SignalFeatures found;
    found.signal = read_measured_signal(request.signal, request.columns, scene);
    found.notes = found.signal.notes;
    const bool long_enough =
        !found.signal.sensor.empty() && found.signal.sensor_meshes >= scene.span_meshes();
    HealthyReference healthy;
    if (!request.healthy.empty()) {
        healthy = measured_reference(request.healthy, request.columns, scene,
                                     planet_turns(found.signal, scene), found.notes);
    } else if (long_enough) {
        healthy = simulated_reference_at(request.noise_level, scene);
    }
    const auto baseline = measured_baseline(request.baseline, request.columns, scene);
    if (baseline) {
        add_notes(baseline->signal, baseline->file, found.notes);
    }
    found.measured = measure(scene, found.signal, healthy, baseline ? &*baseline : nullptr);
    check_any_feature(found.measured.features, request.signal.name, scene, found.signal);
    if (!request.against.empty()) {
        found.against = compared(request, found.measured, scene);
    }
    return found;
}

nlohmann::ordered_json signal_features_json(const SignalFeatures& features,
                                            const SignalRequest& request, const Scene& scene) {
    nlohmann::ordered_json json = measured_json(features, scene);
    if (const auto& change = features.measured.change) {
        json["baseline"] = {{"file", request.baseline.name},
                            {"turned_on_meshes", change->meshes},
                            {"correlation", change->correlation},
                            {"planet_turns", planet_turns(change->signal, scene)}};
    }
    if (features.against) {
        json["against"] =
            decisions_json(*features.against, features.measured.teeth, request.against);
    }
    return json;
}

}  // namespace gearpod::mc
