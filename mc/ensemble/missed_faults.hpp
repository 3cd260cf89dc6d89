// How often faults of one size are missed, where that is rare: records of gearboxes with the fault
// whose noise is tilted towards a miss (signals/windowing/noise_tilt.hpp).
#pragma once

#include <optional>
#include <string>

#include "analysis/detection/tilted_sample.hpp"
#include "mc/ensemble/ensemble_run.hpp"
#include "mc/scene/scene.hpp"

namespace gearpod::mc {

struct MissQuestion {
    std::string feature;
    double threshold = 0.0;    // of its alarm, in its unit
    double noise_level = 1.0;  // of sensor.noise_levels
    double size = 0.0;         // of the fault, SI
    long gearboxes = 0;
    int records = 0;  // of each, a multiple of NoiseTilt::kKinds
};

// The study of one of its features at one noise level.
Study of_feature(const Study& study, const std::string& feature, double noise_level);
// The study whose graded gearboxes all have a fault of that size, SI: all other inputs keep their
// distributions.
Study with_fault(const Study& study, double size);
// Both, with records like these.
Study study_of_misses(const Study& study, const MissQuestion& question);

struct MissAnswer {
    // Rate of misses; empty where too few gearboxes carry it.
    std::optional<analysis::TiltedSample::Estimate> misses;
    long gearboxes = 0, failed = 0;
    long records = 0;  // computed
    // Plain records of as many gearboxes that would be counted for the same error; NaN without
    // `misses`, or if all are missed.
    double counted = 0.0;
};

// Why a run of batches has no answer, or "".
std::string why_left_off(const EnsembleOutcome& outcome);
// How many are counted for a rate with that relative variance; NaN if all are.
double counted_for(double rate, double variance);

// Every rank calls it with the scene of study_of_misses(); the answer is rank 0's. Throws
// std::runtime_error where a batch fails or the run is interrupted.
MissAnswer missed_faults(const Scene& scene, const MissQuestion& question, const Ranks& ranks,
                         Progress& progress, const Interruption* interruption = nullptr);

}  // namespace gearpod::mc
