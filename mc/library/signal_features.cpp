#include "mc/library/signal_features.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace gearpod::mc {
namespace {

// Throws SignalError with the reason if no feature could be computed. Of a signal that is too short
// the message states the smallest number of mesh periods needed.
void check_any_feature(const std::vector<MeasuredFeature>& all, const std::string& name,
                       const FeaturePlan& plan, const MeasuredSignal& signal) {
    const auto good = [](const MeasuredFeature& measured) { return measured.missing.empty(); };
    if (std::any_of(all.begin(), all.end(), good)) {
        return;
    }
    int shortest = 0;
    for (const MeasuredFeature& measured : all) {
        const bool there = (measured.feature->from_sensor ? signal.has_sensor : signal.has_te) &&
                           !(measured.feature->from_sensor && !plan.sensor);
        const bool central = measured.feature->needs.overlaps(features::kCentralGears);
        const int needed = central ? 0 : plan.least_meshes(*measured.feature);
        const int has = measured.feature->from_sensor ? signal.sensor_meshes : signal.te_meshes;
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

SignalFeatures::Against compared(const SignalRequest& request, const SignalFeatures& found,
                                 const MeasurementPlan& plan) {
    std::vector<const features::Feature*> features;
    for (const MeasuredFeature& feature : found.measured.features) {
        features.push_back(feature.feature);
    }
    SignalFeatures::Against against{
        read_population(request.against, request.noise_level, plan.features.teeth), {}};
    against.decided =
        decide(against.population, request.signal.name, features,
               values_of(found.measured.features), request.feature, found.measured.teeth);
    const int turns = found.planet_turns();
    if (!against.population.is_measured && !plan.record.length && found.signal.has_sensor &&
        turns < found.span.ring_teeth) {
        against.decided.sentence += fmt::format(
            " The simulated gearboxes have {} planet turns, the recording has {}: it "
            "averages less, so its features scatter more.",
            found.span.ring_teeth, turns);
    }
    return against;
}

nlohmann::ordered_json measured_json(const SignalFeatures& measured) {
    const MeasuredSignal& signal = measured.signal;
    nlohmann::ordered_json json;
    json["mesh_phase"] = signal.tracking;
    json["losses_noticed"] = signal.losses_detectable;
    json["notes"] = measured.notes;
    json["sensor_meshes"] = signal.sensor_meshes;
    json["te_meshes"] = signal.te_meshes;
    json["span_meshes"] = measured.span.meshes();
    json["planet_turns"] = measured.planet_turns();
    json["features"] = nlohmann::ordered_json::object();
    json["unavailable"] = nlohmann::ordered_json::object();
    for (const MeasuredFeature& feature : measured.measured.features) {
        const std::string name(feature.feature->name);
        if (!feature.missing.empty()) {
            json["unavailable"][name] = feature.missing;
        } else {
            json["features"][name] = feature.value;
        }
    }
    return json;
}

nlohmann::ordered_json decisions_json(const PopulationDecisions& decided,
                                      const std::vector<WorstTooth>& worst,
                                      const std::string& file) {
    nlohmann::ordered_json features = nlohmann::ordered_json::array();
    for (const AlarmDecision& decision : decided.decisions) {
        const auto healthy = static_cast<double>(decision.population->healthy.size());
        features.push_back({{"feature", decision.population->name},
                            {"value", decision.value},
                            {"threshold", decision.population->threshold},
                            {"alarm", decision.alarm},
                            {"margin", decision.margin},
                            {"quantile", static_cast<double>(decision.less_extreme) / healthy},
                            {"healthy", decision.population->healthy.size()}});
    }
    nlohmann::ordered_json teeth = nlohmann::ordered_json::array();
    for (const WorstTooth& tooth : worst) {
        teeth.push_back({{"gear", tooth.gear},
                         {"tooth", tooth.tooth},
                         {"teeth", tooth.teeth},
                         {"ratio", tooth.ratio}});
    }
    return {
        {"file", file},
        {"alarm", decided.mismatch.empty() ? nlohmann::ordered_json(decided.decisions.front().alarm)
                                           : nlohmann::ordered_json(nullptr)},
        {"mismatch", decided.mismatch},
        {"feature", decided.decisions.front().population->name},
        {"sentence", decided.sentence},
        {"features", features},
        {"teeth", teeth}};
}

// Simulated healthy reference at a noise level; empty if the study does not have this level.
HealthyReference reference_at(double noise_level, const TilePlan& tile) {
    const std::vector<double>& levels = tile.record.noise_levels;
    const auto found = std::ranges::find(levels, noise_level);
    if (found == levels.end() || !tile.features.sensor) {
        return {};
    }
    const auto level = static_cast<std::size_t>(found - levels.begin());
    const HealthyReference all = simulated_reference(tile);
    return {{all.residual_variance[level]}};
}

}  // namespace

SignalFeatures signal_features(const SignalRequest& request, const TilePlan& tile) {
    const MeasurementPlan plan{tile.record, tile.features, tile.gearbox->nominal};
    SignalFeatures found;
    found.span = plan.record.span;
    found.signal = read_measured_signal(request.signal, request.columns, plan);
    found.notes = found.signal.notes;
    const bool long_enough =
        !found.signal.sensor.empty() && found.signal.sensor_meshes >= found.span.meshes();
    HealthyReference healthy;
    if (!request.healthy.empty()) {
        healthy = measured_reference(request.healthy, request.columns, plan, found.planet_turns(),
                                     found.notes);
    } else if (long_enough) {
        healthy = reference_at(request.noise_level, tile);
    }
    const auto baseline = measured_baseline(request.baseline, request.columns, plan);
    if (baseline) {
        add_notes(baseline->signal, baseline->file, found.notes);
    }
    found.measured = measure(plan, found.signal, healthy, baseline ? &*baseline : nullptr);
    check_any_feature(found.measured.features, request.signal.name, plan.features, found.signal);
    if (!request.against.empty()) {
        found.against = compared(request, found, plan);
    }
    return found;
}

nlohmann::ordered_json signal_features_json(const SignalFeatures& features,
                                            const SignalRequest& request) {
    nlohmann::ordered_json json = measured_json(features);
    if (const auto& change = features.measured.change) {
        json["baseline"] = {{"file", request.baseline.name},
                            {"turned_on_meshes", change->meshes},
                            {"correlation", change->correlation},
                            {"planet_turns", change->signal.planet_turns(features.span)}};
    }
    if (features.against) {
        json["against"] =
            decisions_json(features.against->decided, features.measured.teeth, request.against);
    }
    return json;
}

}  // namespace gearpod::mc
