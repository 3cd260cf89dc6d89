// Lives of many gearboxes, and what the study's monitoring makes of them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "analysis/monitoring/life_answers.hpp"
#include "mc/lives/life_tile.hpp"

namespace gearpod::mc {

// ensemble.threshold_instances healthy lives set the thresholds, life.healthy_lives others count
// false alarms, in ensemble.instances lives cracks grow.
struct Campaign {
    std::vector<GearboxLife> setting, healthy, cracked;
    LifeCosts costs;
    InterpolationErrors interpolation;  // of the first tile of cracked gearboxes
    long failed = 0;
};

// The same bits for any number of threads. `done` is called after each tile with the number of its
// gearboxes, by one thread at a time.
Campaign run_campaign(const Scene& scene, int threads, const std::function<void(long)>& done);

// Of a feature of the study, or "fused", by one detector.
struct MonitoredFeature {
    std::string feature, detector;
    analysis::LifeAnswers answers;
};
std::vector<MonitoredFeature> monitor(const Study& study, const Campaign& campaign);

}  // namespace gearpod::mc
