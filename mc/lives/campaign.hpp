// Lives of many gearboxes.
#pragma once

#include <string>
#include <vector>

#include "mc/ensemble/ensemble.hpp"
#include "mc/lives/life_tile.hpp"

namespace gearpod::mc {

// ensemble.threshold_instances healthy lives set the thresholds, life.healthy_lives others count
// false alarms, in ensemble.instances lives cracks grow.
struct Campaign {
    std::vector<GearboxLife> setting, healthy, cracked;
    LifeCosts costs;
    InterpolationErrors interpolation;  // the largest of the first eight that crack
    long failed = 0;
    std::string record;  // record_text()
};

// run_batches() of lives: rows as lives_frame() says, of lives_plan(). The same bits for any
// threads, ranks and lanes, and however often it was interrupted.
EnsembleOutcome run_lives(const LifeTiles& tiles, const BatchPlan& plan, const EnsembleRun& run);
// What a record is and what the rows took, into the frame.
void note_run(const Scene& scene, const EnsembleOutcome& outcome, Results& frame);

// Of finished rows; costs are those of the run that wrote them.
Campaign campaign_of(const Study& study, const Results& frame, const RowSource& rows);

// All in memory and in this process.
Campaign run_campaign(const Scene& scene);

}  // namespace gearpod::mc
