// Summary of `run` results over the points of a sweep.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/smallest_fault.hpp"
#include "mc/sweep/grid.hpp"

namespace gearpod::mc {

// Results of a feature at a noise level.
struct FeatureSummary {
    std::string feature;
    double noise_level = 0.0;
    analysis::Auc auc;
    // In the unit of the study file; NaN where the curve does not reach it or there is none.
    double a50 = 0.0, a90 = 0.0, a90_lower = 0.0, a90_bound = 0.0;
    std::vector<double> pd;  // detection rates of the sizes above 0, by ascending size
};

// Smallest fault found at a noise level.
struct LevelSummary {
    double noise_level = 0.0;
    bool has_threshold = true;
    std::optional<analysis::SmallestFault> smallest;  // in the unit of the study file
};

struct PointSummary {
    SweepPoint point;
    std::string results;  // file
    std::size_t gearboxes = 0, failed = 0;
    std::string size_name;  // input that is the fault size
    std::string unit;       // unit of sizes; "": a pure number
    double false_alarm_rate = 0.0, confidence = 0.0;
    std::string shortage;       // warning of too few healthy gearboxes; "" if they suffice
    std::size_t reference = 0;  // index of the noise level that is shown first
    std::vector<double> sizes;  // tested sizes above 0
    std::vector<LevelSummary> levels;
    std::vector<FeatureSummary> features;
};

// Summarises a results file of `run`. Throws std::runtime_error if it is not one, or damaged.
PointSummary summarise(const SweepPoint& point, const std::string& results, int threads);

// Table with a line for each point; its width is not limited.
std::string sweep_text(const std::vector<VariedKey>& keys, const std::vector<PointSummary>& points);

// `title`: title of the study. docs/reference/report-json.md lists the keys.
nlohmann::ordered_json sweep_json(const std::string& title, const std::vector<VariedKey>& keys,
                                  const std::vector<PointSummary>& points);

}  // namespace gearpod::mc
