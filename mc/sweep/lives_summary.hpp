// What the lives of a sweep's points come to, side by side.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "mc/lives/life_monitor.hpp"
#include "mc/sweep/grid.hpp"

namespace gearpod::mc {

struct LivesPoint {
    SweepPoint point;
    std::string results;  // file
    Study study;
    std::size_t cracked = 0;
    long failed = 0;
    std::string record;  // how long one is, and what it hears
    InterpolationErrors interpolation;
    std::vector<MonitoredFeature> monitored;
};

// Of a results file of `lives`. Throws std::runtime_error if it is none, or damaged.
LivesPoint summarise_lives(const SweepPoint& point, const std::string& results);

// The feature and detector that find most over all points, then shallowest; nullptr where no point
// has a threshold.
const MonitoredFeature* best_over(const std::vector<LivesPoint>& points);

// A table with a line a point, by best_over(), and which are best at that point.
std::string lives_sweep_text(const std::vector<VariedKey>& keys,
                             const std::vector<LivesPoint>& points);

// `title`: the study's. The keys are in mc/README.md.
nlohmann::json lives_sweep_json(const std::string& title, const std::vector<VariedKey>& keys,
                                const std::vector<LivesPoint>& points);

}  // namespace gearpod::mc
