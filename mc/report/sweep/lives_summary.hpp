// Summary of `lives` results over the points of a sweep.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "analysis/report/report.hpp"
#include "mc/lives/life_monitor.hpp"
#include "mc/report/sweep/grid.hpp"

namespace gearpod::mc {

struct LivesPoint : PointResults {
    CampaignPlan plan;
    std::size_t cracked = 0;
    // One entry for each gearbox with a crack: 1 if the tooth fails within the records, 0 if not,
    // -1 if its features have no values.
    std::vector<int> tooth_failed;
    long failed = 0;
    std::string record;  // description of a record
    InterpolationErrors interpolation;
    std::vector<MonitoredFeature> monitored;
    std::vector<std::size_t> ranking;  // result of LifeMonitor::ranking(); empty if withheld
};

struct LivesSweep {
    std::string title;  // of the study
    std::vector<VariedKey> keys;
    std::vector<LivesPoint> points;
    // Results of every feature, with the detector that is best over all points: that which finds
    // most cracks net of chance; with equal shares, the one that finds the smallest cracks. The
    // best feature first; empty if none has a rank at any point.
    std::vector<MonitoredFeature> order;
};

// Summarises the results files of `lives`, one for each point. Throws std::runtime_error if one is
// not such a file, or damaged.
LivesSweep summarise_lives(const std::string& title, const std::vector<VariedKey>& keys,
                           const std::vector<SweepPoint>& points,
                           const std::vector<std::string>& results);

// Sections: the headline with the table of all points for the best feature and detector, and
// details.
analysis::Report lives_sweep_report(const LivesSweep& sweep);

// docs/reference/report-json.md lists the keys.
nlohmann::json lives_sweep_json(const LivesSweep& sweep);

}  // namespace gearpod::mc
