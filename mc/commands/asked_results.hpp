// Commands that compute more gearboxes of a finished run's study, for one of its features.
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
#include "mc/numerics/study_scene.hpp"
#include "mc/results/results_file.hpp"

namespace gearpod::mc {

// Every option that is wrong, a line each.
class Complaints {
  public:
    void add(const std::string& option, const std::string& what);
    // Throws std::runtime_error if there are any.
    void end() const;

  private:
    std::string text_;
};

struct AskedResults {
    std::string path;
    Results frame;  // with detection
    Study study;
};
// Throws std::runtime_error naming the file where it is not what a run writes.
AskedResults read_asked(const std::string& path);

// One of the file's features at one of its noise levels.
struct AskedFeature {
    const features::Feature* feature;
    const analysis::LevelDetection* detection;
};
// Without a level the one that reports show first. Complains of --feature and --noise-level.
std::optional<AskedFeature> find_asked(const AskedResults& results, const std::string& feature,
                                       const std::optional<double>& noise_level,
                                       Complaints& complaints);
// Complains of what has no threshold.
void needs_threshold(const AskedFeature& asked, Complaints& complaints);

// A fault's size as it is asked for.
struct AskedSize {
    double si = 0.0, given = 0.0;
    std::string unit;  // of the study's key, "" of a pure number
};
// Complains of --size. Of a study with a fault.
AskedSize ask_size(const Study& study, double size, Complaints& complaints);
// ">" or "<", as its alarm is.
const char* alarm_symbol_of(const std::string& feature);
// "faults of 2 mm that fm4 misses at noise x 1 (alarm if > 3.1): "
std::string asked_misses(const AskedSize& size, const std::string& feature, double noise_level,
                         double threshold);

// Of a study made from the file's. Throws what is wrong with it: with the fault's size, of the
// option --size, or with what the file holds.
StudyScene scene_of_asked(const AskedResults& results, const Study& study);

// Calls `prepare`, which may throw, in every rank. False after its problem was printed.
bool prepare_together(const Ranks& ranks, const std::string& results, const std::string& json,
                      const std::function<void()>& prepare);

// What rank 0 answers.
struct Answered {
    std::string text;
    nlohmann::json json;
    long failed = 0;  // gearboxes
};
// Calls `compute`, which may throw, in every rank; prints rank 0's text, unless JSON goes to the
// terminal, and writes JSON where it is asked for. The exit code.
int answer_together(const Ranks& ranks, Progress& progress, const std::string& json,
                    const std::function<Answered()>& compute);

}  // namespace gearpod::mc
