// Points of a sweep: one study for each combination of the values of some keys. Summaries of the
// results of `run` and of `lives` over them, and the comparison of two results files, with the same
// gearboxes or without; docs/reference/report-json.md lists the keys of their JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/comparison/comparison.hpp"
#include "analysis/comparison/comparison_report.hpp"
#include "analysis/reliability.hpp"
#include "analysis/report/report.hpp"
#include "machine/fields.hpp"
#include "mc/files/input/problems.hpp"
#include "mc/lives/life_monitor.hpp"
#include "mc/plan/study_facts.hpp"
#include "mc/results/results_file.hpp"

namespace gearpod::mc {

struct VariedKey {
    std::string key;                  // "sensor.noise_m_s2"
    std::vector<std::string> values;  // as TOML text
};
GEARPOD_FIELDS(VariedKey, key, values)

// Parses texts "section.key=[a, b, c]" with any TOML values, including tables and arrays. Problems
// name `--vary`.
std::vector<VariedKey> read_varied(const std::vector<std::string>& texts, Problems& problems);

struct SweepPoint {
    std::vector<std::string> values;     // in the order of the keys
    std::vector<std::string> labels;     // of the values, for tables and sentences
    std::vector<std::string> overrides;  // "section.key=value", as for `run --set`
    std::string name;                    // file name without extension: "noise_m_s2=2_gain=1"
};

struct PointResults {
    SweepPoint point;
    std::string results;
};

// Limit of the number of points, which keeps the table readable.
inline constexpr std::size_t kMostPoints = 10000;

// Returns all combinations; the last key varies fastest. Names are distinct. A point has the same
// name in a larger grid. Returns none beyond kMostPoints.
std::vector<SweepPoint> grid_of(const std::vector<VariedKey>& keys);

// Names of points, at most five: "gain = 1; gain = 2; and 3 more".
std::string names_text(const std::vector<std::string>& points);

// Returns the key without its section.
std::string short_key(const std::string& key);
// Labels of a key's values: "uniform, high=2, low=1" for { distribution = "uniform", low = 1, high
// = 2 }. Long ones are clipped, and numbered where they would be the same.
std::vector<std::string> value_labels(const std::vector<std::string>& toml);
// "noise_m_s2 = 2, gain = 1".
std::string point_text(const std::vector<VariedKey>& keys, const SweepPoint& point);
// Columns of a table with a row for each point: the keys.
std::vector<std::string> key_columns(const std::vector<VariedKey>& keys);
// The beginning, and at how many of the other points the result is larger or smaller (`beyond`)
// than at the best one by more than scatter; `within`: names of those where it is not.
std::string within_scatter_text(const std::string& begin, const char* beyond, std::size_t count,
                                const std::vector<std::string>& within);
nlohmann::json values_json(const std::vector<VariedKey>& keys, const SweepPoint& point);
// Section with what all points have in common, and their results files.
analysis::Section files_section(const std::vector<VariedKey>& keys,
                                const std::vector<PointResults>& points);

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
    analysis::DetectionRequest request;
    std::string shortage;       // warning of too few healthy gearboxes; "" if they suffice
    std::size_t reference = 0;  // index of the noise level that is shown first
    std::vector<double> sizes;  // tested sizes above 0
    std::vector<LevelSummary> levels;
    std::vector<FeatureSummary> features;

    const analysis::SizeUnit& size() const { return request.size; }
};

// Differences of a90 between the point where it is smallest and the others, gearbox by gearbox
// where they have the same ones.
struct SweepDifferences {
    std::string feature;                          // that finds the smallest fault at most points
    std::optional<std::size_t> best;              // point; empty if no point has its a90
    bool paired = true;                           // the points have the same gearboxes
    int resamples = 0;                            // bootstrap samples of each difference
    std::vector<analysis::NumberDifference> a90;  // by point, minus the best point's

    // Difference of a point; null without one.
    const analysis::NumberDifference* known(std::size_t point) const {
        return point < a90.size() && a90[point].refusal.empty() ? &a90[point] : nullptr;
    }
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

nlohmann::json sweep_json(const RunSweep& sweep);

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
    std::string withheld;              // reason (why_withheld); "" if the results are given
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

nlohmann::json lives_sweep_json(const LivesSweep& sweep);

// Comparison of two results files of `run`, gearbox by gearbox where seed and sizes agree.

// Results file with the rows of its two groups.
struct ComparedSide {
    std::string path;
    Results frame;                             // includes the columns
    std::vector<std::size_t> threshold, test;  // rows
    std::optional<RunFacts> facts;             // empty if the study cannot be read
};

// Reads a results file. Throws std::runtime_error if it is not one of `run`, or damaged.
ComparedSide read_compared(const std::string& path);

// Reasons why two files cannot be compared, one line each; "" if they can.
std::string mismatch(const ComparedSide& a, const ComparedSide& b);

// Feature and noise level to compare; by default all.
struct ComparedSelection {
    std::string feature;
    double noise_level = 0.0;

    bool holds(const std::string& other, double level) const {
        return feature.empty() || (feature == other && noise_level == level);
    }
};

// Adds the comparison of `b` with `a` to the entry of `b`. The request's confidence and resamples
// are used.
void compare_with(const ComparedSide& a, const ComparedSide& b, analysis::ComparisonRequest request,
                  const ComparedSelection& selection, analysis::ComparedFile& file);

}  // namespace gearpod::mc
