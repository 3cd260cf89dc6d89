// What the results of a sweep's points say, side by side.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/smallest_fault.hpp"
#include "mc/sweep/grid.hpp"

namespace gearpod::mc {

// Of a feature at a noise level.
struct FeatureSummary {
    std::string feature;
    double noise_level = 0.0;
    analysis::Auc auc;
    // In the unit of the study file; NaN where the curve does not reach it or there is none.
    double a50 = 0.0, a90 = 0.0, a90_lower = 0.0, a90_bound = 0.0;
    std::vector<double> pd;  // of the sizes above 0, ascending
};

// The headline of a noise level.
struct LevelSummary {
    double noise_level = 0.0;
    bool has_threshold = true;
    std::optional<analysis::SmallestFault> smallest;  // in the unit of the study file
};

struct PointSummary {
    SweepPoint point;
    std::string results;  // file
    std::size_t gearboxes = 0, failed = 0;
    std::string size_name;  // of the input that is the fault's size
    std::string unit;       // of sizes, "" of a pure number
    double false_alarm_rate = 0.0, confidence = 0.0;
    std::string shortage;       // what its healthy gearboxes do not carry, "" if they suffice
    std::size_t reference = 0;  // place of the level that is shown first
    std::vector<double> sizes;  // tested, above 0
    std::vector<LevelSummary> levels;
    std::vector<FeatureSummary> features;
};

// Of a results file of `run`. Throws std::runtime_error if it is none, or damaged.
PointSummary summarise(const SweepPoint& point, const std::string& results, int threads);

// A table with a line a point; as wide as it needs.
std::string sweep_text(const std::vector<VariedKey>& keys, const std::vector<PointSummary>& points);

// `title`: the study's. The keys are in mc/README.md.
nlohmann::ordered_json sweep_json(const std::string& title, const std::vector<VariedKey>& keys,
                                  const std::vector<PointSummary>& points);

}  // namespace gearpod::mc
