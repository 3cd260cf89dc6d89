// Lives of many gearboxes, and what the study's monitoring makes of them.
#pragma once

#include <string>
#include <vector>

#include "analysis/monitoring/life_answers.hpp"
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

// Of a feature of the study, or "fused", by one detector.
struct MonitoredFeature {
    std::string feature, detector;
    analysis::LifeAnswers answers;
};
std::vector<MonitoredFeature> monitor(const Study& study, const Campaign& campaign);

// What more or fewer false alarms would win or lose, by the detector that is best at the study's.
struct TradeOff {
    struct Point {
        double stated_per_1000_h, per_1000_h;  // set, and counted on other lives
        double share, depth_50_m, depth_90_m;
    };
    std::string feature, detector;
    std::vector<Point> points;
};
std::vector<TradeOff> trade_offs(const Study& study, const Campaign& campaign,
                                 const std::vector<MonitoredFeature>& monitored);

// Deviations from the own baseline, by record: of the healthy lives that count false alarms 5, 50
// and 95 %, and of the first lives with a crack each; NaN where the monitor sees none.
struct FeatureFan {
    std::string feature;
    std::vector<double> low, median, high;
    std::vector<std::vector<double>> lives;
};
std::vector<FeatureFan> fans(const Study& study, const Campaign& campaign);

}  // namespace gearpod::mc
