// Summary of `run` results over the points of a sweep.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/comparison/comparison.hpp"
#include "analysis/reliability.hpp"
#include "analysis/report/report.hpp"
#include "mc/report/sweep/grid.hpp"

namespace gearpod::mc {

// Results of a feature at a noise level. Sizes are in the unit of the file (SI).
struct FeatureSummary {
    std::string feature;
    double noise_level = 0.0;
    analysis::Auc auc;
    bool has_curve = false;
    analysis::SizeBounds a50, a90;         // of the curve; the bounds are one-sided
    double smallest = 0.0, largest = 0.0;  // tested sizes
    std::vector<double> pd;                // detection rates of the sizes above 0, ascending
};

// Smallest fault found at a noise level.
struct LevelSummary {
    double noise_level = 0.0;
    bool has_threshold = true;
    std::optional<analysis::SmallestFault> smallest;
};

struct PointSummary : PointResults {
    std::size_t gearboxes = 0, failed = 0;
    analysis::SizeUnit size;
    double false_alarm_rate = 0.0, confidence = 0.0;
    std::string shortage;       // warning of too few healthy gearboxes; "" if they suffice
    std::size_t reference = 0;  // index of the noise level that is shown first
    std::vector<double> sizes;  // tested sizes above 0
    std::vector<LevelSummary> levels;
    std::vector<FeatureSummary> features;
};

// Differences of a90 between the point where it is smallest and the others, gearbox by gearbox
// where they have the same ones.
struct SweepDifferences {
    std::string feature;                          // that finds the smallest fault at most points
    std::optional<std::size_t> best;              // point; empty if no point has its a90
    bool paired = true;                           // the points have the same gearboxes
    int resamples = 0;                            // bootstrap samples of each difference
    std::vector<analysis::NumberDifference> a90;  // by point, minus the best point's
};

struct RunSweep {
    std::string title;  // of the study
    std::vector<VariedKey> keys;
    std::vector<PointSummary> points;
    std::vector<std::string>
        order;  // features, those first that find the smallest fault most often
    SweepDifferences differences;
};

// Summarises the results files of `run`, one for each point. Throws std::runtime_error if one is
// not such a file, or damaged.
RunSweep summarise_runs(const std::string& title, const std::vector<VariedKey>& keys,
                        const std::vector<SweepPoint>& points,
                        const std::vector<std::string>& results, int threads);

// Sections: the headline with the table of all points, and details.
analysis::Report sweep_report(const RunSweep& sweep);

// docs/reference/report-json.md lists the keys.
nlohmann::ordered_json sweep_json(const RunSweep& sweep);

}  // namespace gearpod::mc
