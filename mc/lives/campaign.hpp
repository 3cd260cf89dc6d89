// Lives as rows of a results file.
#pragma once

#include <string>
#include <vector>

#include "mc/ensemble/ensemble.hpp"
#include "mc/ensemble/results_check.hpp"
#include "mc/lives/life_tile.hpp"

namespace gearpod::mc {

// Batches of lives. The threshold group contains the healthy lives: first
// ensemble.threshold_instances that determine the thresholds, then life.healthy_lives that count
// false alarms. Cracks grow in the test group.
BatchPlan lives_plan(const CampaignPlan& plan);

// Results of kind kLivesKind without rows; the columns are empty.
Results lives_frame(const CampaignPlan& plan);

// Checks the rows. Returns the plan by which they were computed. Throws std::runtime_error as
// check_results() does.
CampaignPlan check_lives(const std::string& path, const Results& frame, const RowSource& rows);

bool measures_interpolation(const GearboxId& id);

void add_life(const CampaignPlan& plan, const Realization& gearbox, const GearboxLife& life,
              const InterpolationErrors& errors, BatchRows& rows);

// Life in a row of such a frame.
struct LifeRow {
    GearboxLife life;
    InterpolationErrors interpolation;
};
LifeRow life_of_row(const CampaignPlan& plan, const Results& frame, const ResultRow& row);

// Simulates the lives of many gearboxes.

// Lives of a study: ensemble.threshold_instances healthy lives determine the thresholds,
// life.healthy_lives further ones count false alarms, and ensemble.instances lives have growing
// cracks.
struct Campaign {
    std::vector<GearboxLife> threshold_lives, healthy, cracked;
    LifeCosts costs;
    InterpolationErrors interpolation;  // maximum over the first eight gearboxes with a crack
    long failed = 0;
    std::string record;  // LifePlan::record
};

// Runs run_batches() for lives; rows as in lives_frame(), batches as in lives_plan(). The result
// does not depend on threads, ranks, lanes and interruptions, to the last bit.
EnsembleOutcome run_lives(const LifeTiles& tiles, const BatchPlan& plan, const EnsembleRun& run);
// Stores the description of a record, the error between the integrated loads and the cost of the
// rows in the frame.
void store_run_costs(const LifePlan& plan, double interpolation_error,
                     const EnsembleOutcome& outcome, Results& frame);

// Reads a campaign from finished rows; the costs are those of the run that wrote them.
Campaign campaign_of(const CampaignPlan& plan, const Results& frame, const RowSource& rows);

}  // namespace gearpod::mc
