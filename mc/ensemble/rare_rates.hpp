// How rare alarms of healthy gearboxes are, or misses of a fault, where gearboxes make them: their
// own draws are split (analysis/detection/splitting.hpp).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/detection/splitting.hpp"
#include "mc/ensemble/ensemble_run.hpp"
#include "mc/scene/scene.hpp"

namespace gearpod::mc {

// Of healthy gearboxes the threshold whose false-alarm rate is asked for; or the rate at which
// those with a fault are missed by a threshold.
struct RareQuestion {
    std::string feature;
    double noise_level = 1.0;    // of sensor.noise_levels
    std::optional<double> rate;  // of false alarms; else of misses:
    double size = 0.0;           // of the fault, SI
    double threshold = 0.0;      // of its alarm, in its unit
    long gearboxes = 0;          // of a level

    // A miss lies on the threshold's other side.
    analysis::Alarm towards() const;
};

// Misses that are rarer are not looked for.
inline constexpr double kRarestMisses = 1e-9;

// The study whose gearboxes are split: healthy ones are those of its threshold group.
Study study_of_rare(const Study& study, const RareQuestion& question);

// A random input that gearboxes near an alarm or a miss have otherwise than all have.
struct ShiftedInput {
    std::string name, unit;        // as of the results' column
    double all = 0.0, rare = 0.0;  // means
};

struct RareAnswer {
    // Empty where too few gearboxes' descendants reach so far.
    std::optional<analysis::SplitTail::Estimate> estimate;
    analysis::Interval threshold;   // of false alarms: where it may lie
    long computed = 0, failed = 0;  // gearboxes
    std::size_t levels = 0;
    double last_rate = 1.0;   // of gearboxes like the last level's
    double least_kept = 1.0;  // share of a level's exchanges
    // Gearboxes that would be counted for the same error; NaN without an estimate.
    double counted = 0.0;
    std::vector<ShiftedInput> shifted;  // of the last level
};

// Gearboxes that it computes at most.
long rare_gearboxes(const RareQuestion& question);

// Every rank calls it with the scene of study_of_rare(); the answer is rank 0's. Throws
// std::runtime_error where a batch fails or the run is interrupted.
RareAnswer rare_rates(const Scene& scene, const RareQuestion& question, const Ranks& ranks,
                      Progress& progress, const Interruption* interruption = nullptr);

}  // namespace gearpod::mc
