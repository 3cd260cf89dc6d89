// Lives in memory and in this process.
#pragma once

#include <stdexcept>

#include "machine/no_value.hpp"
#include "mc/lives/campaign.hpp"

namespace gearpod::mc {

// Simulates all lives of a study at the integrated loads of the plan.
inline Campaign run_campaign(const LifeTiles& tiles) {
    const CampaignPlan& campaign = tiles.plan().campaign;
    const BatchPlan plan = lives_plan(campaign);
    MemoryRows store(plan.batches());
    const Ranks alone;
    Progress silent(1, true);
    const EnsembleOutcome outcome =
        run_lives(tiles, plan, {.ranks = alone, .store = store, .progress = silent});
    if (!outcome.failure.empty()) {
        throw std::runtime_error(outcome.failure);
    }
    Results frame = lives_frame(campaign);
    store_run_costs(tiles.plan(), kNan, outcome, frame);
    return campaign_of(campaign, frame, StoredRows(store, plan, outcome.batches));
}

}  // namespace gearpod::mc
