#include "mc/scene/feature_needs.hpp"

#include <algorithm>
#include <stdexcept>

#include "mc/study/gears.hpp"

namespace gearpod::mc {
namespace {

constexpr unsigned kOfSamples = features::kSensorTurn | features::kSun | features::kRing |
                                features::kPlanetMoments | features::kFiltered | features::kChange;

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

unsigned needs_of(std::span<const features::Feature* const> features) {
    unsigned needs = 0;
    for (const features::Feature* feature : features) {
        needs |= feature->needs;
    }
    return needs;
}

ComparedNeeds compared_needs(std::span<const features::Feature* const> features) {
    ComparedNeeds needs;
    for (const features::Feature* feature : features) {
        switch (feature->baseline_use) {
            case features::BaselineUse::nothing:
                needs.record |= feature->needs;
                break;
            case features::BaselineUse::change:
                needs.record |= features::kChange;
                needs.baseline |= features::kChange;
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

bool needs_samples(unsigned needs) {
    return (needs & kOfSamples) != 0;
}

int meshes_needed(const Study& study, const signals::SpanLayout& span, unsigned needs) {
    int meshes = span.meshes();
    if ((needs & features::kSun) != 0) {
        meshes = std::max(meshes, central_turns(span, *teeth_of(study, Member::sun)).meshes());
    }
    if ((needs & features::kRing) != 0) {
        meshes = std::max(meshes, central_turns(span, *teeth_of(study, Member::ring)).meshes());
    }
    return meshes;
}

signals::GearTurns central_turns(const signals::SpanLayout& span, int teeth) {
    const auto turns = signals::turns_of_span(teeth, span.carrier_meshes, span.meshes());
    return turns.turns > 0 ? turns : signals::fewest_turns(teeth, span.carrier_meshes);
}

}  // namespace gearpod::mc
