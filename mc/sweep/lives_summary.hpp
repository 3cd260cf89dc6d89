// Summary of `lives` results over the points of a sweep.
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
    std::string record;  // description of a record
    InterpolationErrors interpolation;
    std::vector<MonitoredFeature> monitored;
    std::vector<std::size_t> ranking;  // result of LifeMonitor::ranking(); empty if withheld
};

// Summarises a results file of `lives`. Throws std::runtime_error if it is not one, or damaged.
LivesPoint summarise_lives(const SweepPoint& point, const std::string& results);

// Returns the feature and detector that find most cracks net of chance over all points where they
// have a rank; with equal shares, those that find the smallest cracks. Null if none has a rank.
const MonitoredFeature* best_over(const std::vector<LivesPoint>& points);

// Table with a line for each point: the results of best_over(), and the best detector at the point.
std::string lives_sweep_text(const std::vector<VariedKey>& keys,
                             const std::vector<LivesPoint>& points);

// `title`: title of the study. docs/reference/report-json.md lists the keys.
nlohmann::json lives_sweep_json(const std::string& title, const std::vector<VariedKey>& keys,
                                const std::vector<LivesPoint>& points);

}  // namespace gearpod::mc
