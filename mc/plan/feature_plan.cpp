#include "mc/plan/feature_plan.hpp"

#include <algorithm>
#include <stdexcept>

namespace gearpod::mc {
namespace {

using features::SignalSet;

constexpr SignalSet kFolded =
    SignalSet::of<features::TeTurn, features::SensorPower, features::ToothRms<Member::planet>,
                  features::TeParts, features::HealthyRecords>();

// Turns of a central gear that fit into the span, or the smallest number that is enough.
signals::GearTurns turns_of_gear(const signals::SpanLayout& span, int teeth) {
    const auto turns = signals::turns_of_span(teeth, span.carrier_meshes, span.meshes());
    return turns.turns > 0 ? turns : signals::fewest_turns(teeth, span.carrier_meshes);
}

}  // namespace

ComparedNeeds compared_needs(std::span<const features::Feature* const> features, bool superposed) {
    using features::BaselineUse;
    constexpr SignalSet kSamples = SignalSet::of<features::SensorSamples>();
    ComparedNeeds needs;
    for (const features::Feature* feature : features) {
        const BaselineUse use = feature->baseline_use;
        const bool changes = use == BaselineUse::change || use == BaselineUse::record_and_change;
        if (use != BaselineUse::change) {
            needs.record |= feature->needs;
        }
        if (changes) {
            needs.change |= feature->needs;
        }
        if (changes && !superposed) {
            needs.record |= kSamples;
            needs.baseline |= kSamples;
        }
        if (use == BaselineUse::baseline || (changes && superposed && feature->external)) {
            needs.baseline |= feature->needs;
        }
    }
    return needs;
}

bool needs_samples(SignalSet needs) {
    return !needs.within(kFolded);
}

int FeaturePlan::meshes_needed(SignalSet with_needs) const {
    int meshes = span.meshes();
    if (with_needs.has<features::ToothRms<Member::sun>, features::ToothMoments<Member::sun>>()) {
        meshes = std::max(meshes, sun->meshes());
    }
    if (with_needs.has<features::ToothRms<Member::ring>, features::ToothMoments<Member::ring>>()) {
        meshes = std::max(meshes, ring->meshes());
    }
    return meshes;
}

signals::GearTurns FeaturePlan::central_turns(Member gear, int meshes) const {
    const signals::GearTurns& most = (gear == Member::sun ? sun : ring).value();
    const auto fitting = signals::turns_of_span(most.teeth, span.carrier_meshes, meshes);
    return {most.teeth, std::min(most.turns, fitting.turns)};
}

int FeaturePlan::least_meshes(const features::Feature& feature) const {
    const features::SignalSet signals = feature.needs;
    int least = span.planet_teeth;
    // Cyclic statistics of the samples tell the lines of the planet turn from their neighbours.
    if (signals.has<features::SensorSamples>() && signals.has<features::SensorTurn>()) {
        least = kLeastRecordTurns * span.planet_teeth;
    }
    // A single carrier turn does not differ from its average.
    if (signals.has<features::FilteredSensor>()) {
        least = std::max(least, 2 * span.carrier_meshes);
    }
    const auto add = [&](Member gear) {
        const auto turns = gearpod::signals::fewest_turns(teeth[gear], span.carrier_meshes);
        least = std::max(least, turns.meshes());
    };
    if (signals.has<features::ToothRms<Member::sun>, features::ToothMoments<Member::sun>>()) {
        add(Member::sun);
    }
    if (signals.has<features::ToothRms<Member::ring>, features::ToothMoments<Member::ring>>()) {
        add(Member::ring);
    }
    return least;
}

FeaturePlan make_feature_plan(const Study& study, const signals::SpanLayout& span) {
    FeaturePlan plan;
    plan.used = used_features(study);
    plan.python = study.features.python;
    plan.needs = compared_needs(plan.used);
    plan.baselines = plan.needs.baseline.empty() ? 0 : study.features.baseline_records;
    plan.tukey_taper = study.features.tukey_taper;
    plan.te_harmonics = study.features.te_harmonics;
    plan.span = span;
    for (const Member member : kAllMembers) {
        plan.teeth[member] = study.gearbox.bodies[member].teeth.value_or(0);
    }
    if (study.gearbox.kind == GearboxKind::planetary) {
        plan.planets = study.gearbox.planets;
        plan.sun = turns_of_gear(span, plan.teeth[Member::sun]);
        plan.ring = turns_of_gear(span, plan.teeth[Member::ring]);
    }
    plan.signal_meshes = plan.meshes_needed(plan.needs.all());
    plan.low_pass_Hz = study.sensor.low_pass_Hz;
    plan.average_recordings = study.monitoring.average_records;
    plan.sensor = !study.effects.quasi_static();
    return plan;
}

std::vector<const features::Feature*> used_features(const Study& study) {
    std::vector<const features::Feature*> used;
    for (const std::string& name : study.features.use) {
        const features::Feature* feature = find_feature(study, name);
        if (feature == nullptr) {
            throw std::invalid_argument("unknown feature " + name);
        }
        used.push_back(feature);
    }
    return used;
}

}  // namespace gearpod::mc
