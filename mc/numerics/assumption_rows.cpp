#include "mc/numerics/assumption_rows.hpp"

#include <algorithm>

#include "mc/ensemble/batch_workers.hpp"
#include "mc/numerics/numerical_error.hpp"

namespace gearpod::mc {

AssumptionPairs assumption_pairs(const Planner& planner) {
    constexpr long kFewest = 8, kMost = 16;
    const analysis::DetectionRequest request = planner.ensemble(planner.facts().numerics).request;
    const bool faulty = std::ranges::any_of(
        request.groups, [](const analysis::SizeGroup& group) { return group.high > 0.0; });
    if (!faulty || request.importance_sampling) {
        return {};
    }
    AssumptionPairs all{planner.assumption_variants(), 0};
    const auto affordable = [&] {
        return planner.facts().gearboxes / 10 / static_cast<long>(all.variants.size());
    };
    while (!all.variants.empty() && affordable() < kFewest) {
        const std::string last = all.variants.back().key;
        std::erase_if(all.variants,
                      [&](const AssumptionVariant& variant) { return variant.key == last; });
    }
    if (!all.variants.empty()) {
        all.pairs = static_cast<int>(std::min(kMost, affordable()));
    }
    return all;
}

AssumptionRows assumption_rows(const Planner& planner, const std::function<void(long)>& computed) {
    const auto [variants, pairs] = assumption_pairs(planner);
    if (variants.empty()) {
        return {};
    }
    const Numerics& numerics = planner.facts().numerics;
    const TilePlan tile = planner.tile(numerics);
    const std::vector<GearboxId> ids = paired_gearboxes(tile, planner.ensemble(numerics), pairs);
    AssumptionRows all = changed_rows(tile.draw().rows, ids);
    for (const AssumptionVariant& variant : variants) {
        try {
            const Planner changed = variant.planner();
            const EnsemblePlan ensemble = changed.ensemble(numerics);
            all.changed.push_back(
                {variant.key, variant.factor,
                 feature_values(ensemble.shape,
                                rows_of_gearboxes(changed.tile(numerics), ensemble, ids))});
        } catch (const SceneError&) {
            // Beyond the range of the key, such as a grade above 12.
        }
        computed(static_cast<long>(ids.size()));
    }
    return all;
}

}  // namespace gearpod::mc
