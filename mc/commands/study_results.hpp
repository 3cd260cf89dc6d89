// Shared parts of the commands that compute more gearboxes of a finished run's study, for one of
// its features (`misses`, `rare`).
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "analysis/detection/detection_table.hpp"
#include "features/feature.hpp"
#include "mc/commands/commands.hpp"
#include "mc/ensemble/progress.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/files/input/problems.hpp"
#include "mc/library/run/command_files.hpp"
#include "mc/numerics/numerics_choice.hpp"
#include "mc/plan/study_facts.hpp"
#include "mc/results/results_file.hpp"

namespace gearpod::mc {

// Throws std::runtime_error with all problems, one line each, if there are any.
void require_none(const Problems& problems);

struct StudyResults {
    std::string path;
    Results frame;  // includes the detection results
    RareEventSource source;
};
// Reads a results file of `run`. Throws std::runtime_error naming the file if it is not one.
StudyResults read_study_results(const std::string& path);

// Feature of the file at one of its noise levels.
struct FeatureAtLevel {
    const features::Feature* feature;
    const analysis::LevelDetection* detection;
};
// Finds the requested feature. Without a noise level it uses reference_level(). Reports wrong
// values of --feature and --noise-level to `problems`.
std::optional<FeatureAtLevel> find_feature_at_level(const StudyResults& results,
                                                    const std::string& feature,
                                                    const std::optional<double>& noise_level,
                                                    Problems& problems);
// Reports --feature to `problems` if the feature has no threshold.
void require_threshold(const FeatureAtLevel& requested, Problems& problems);

// Fault size given by --size.
struct RequestedSize {
    double si = 0.0, given = 0.0;
    std::string unit;  // of the study's key; "": a pure number
};
// Reads --size and reports a wrong value to `problems`. The study must have a fault.
RequestedSize read_requested_size(const FaultPlan& fault, double size, Problems& problems);
// Alarm direction of a feature: ">" or "<".
const char* alarm_symbol_of(const std::string& feature);
// "probability that fm4 misses a fault of 2 mm at noise x 1 (alarm if > 3.1): "
std::string miss_probability_text(const RequestedSize& size, const std::string& feature,
                                  double noise_level, double threshold);

// Builds the scene of the text of a study derived from the file's study. Throws std::runtime_error
// with every problem. A problem with the fault size names --size, every other one names the file.
StudyScene scene_for_results(const StudyResults& results, const std::string& study);

// Calls `prepare`, which may throw, in every rank. Returns false in all ranks if one of them
// failed, or if the JSON cannot be written; rank 0 has then printed the problem. `force`: the JSON
// may replace a file of another kind.
bool prepare_together(const Ranks& ranks, const std::string& results, const FileRole& json,
                      bool force, const std::function<void()>& prepare);

// Result of a command in rank 0.
struct CommandResult {
    std::string text;
    nlohmann::json json;
    long failed = 0;  // gearboxes
};
// Calls `compute`, which may throw, in every rank. Rank 0 prints the text, unless JSON goes to
// standard output, and writes the JSON if requested. Returns the exit code.
int compute_together(const Ranks& ranks, Progress& progress, const std::string& json,
                     const std::function<CommandResult()>& compute);

}  // namespace gearpod::mc
