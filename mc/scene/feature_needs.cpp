#include "mc/scene/feature_needs.hpp"

#include <algorithm>
#include <stdexcept>

#include "mc/study/gears.hpp"

namespace gearpod::mc {
namespace {

using features::Gear;
using features::SignalSet;

// Signals of folded records.
constexpr SignalSet kFolded =
    SignalSet::of<features::TeTurn, features::SensorPower, features::ToothRms<Gear::planet>,
                  features::TeParts, features::HealthyRecords>();

}  // namespace

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

SignalSet needs_of(std::span<const features::Feature* const> features) {
    const ComparedNeeds needs = compared_needs(features);
    SignalSet all = needs.record;
    all |= needs.change;
    return all;
}

ComparedNeeds compared_needs(std::span<const features::Feature* const> features) {
    ComparedNeeds needs;
    for (const features::Feature* feature : features) {
        switch (feature->baseline_use) {
            case features::BaselineUse::nothing:
                needs.record |= feature->needs;
                break;
            case features::BaselineUse::change:
                needs.record |= SignalSet::of<features::SensorSamples>();
                needs.baseline |= SignalSet::of<features::SensorSamples>();
                needs.change |= feature->needs;
                break;
            case features::BaselineUse::record_and_change:
                needs.record |= feature->needs;
                needs.record |= SignalSet::of<features::SensorSamples>();
                needs.baseline |= SignalSet::of<features::SensorSamples>();
                needs.change |= feature->needs;
                break;
            case features::BaselineUse::baseline:
                needs.record |= feature->needs;
                needs.baseline |= feature->needs;
                break;
        }
    }
    return needs;
}

bool needs_samples(SignalSet needs) {
    return !needs.within(kFolded);
}

int meshes_needed(const Study& study, const signals::SpanLayout& span, SignalSet needs) {
    int meshes = span.meshes();
    if (needs.has<features::ToothRms<Gear::sun>, features::ToothMoments<Gear::sun>>()) {
        meshes = std::max(meshes, central_turns(span, *teeth_of(study, Member::sun)).meshes());
    }
    if (needs.has<features::ToothRms<Gear::ring>, features::ToothMoments<Gear::ring>>()) {
        meshes = std::max(meshes, central_turns(span, *teeth_of(study, Member::ring)).meshes());
    }
    return meshes;
}

signals::GearTurns central_turns(const signals::SpanLayout& span, int teeth) {
    const auto turns = signals::turns_of_span(teeth, span.carrier_meshes, span.meshes());
    return turns.turns > 0 ? turns : signals::fewest_turns(teeth, span.carrier_meshes);
}

}  // namespace gearpod::mc
