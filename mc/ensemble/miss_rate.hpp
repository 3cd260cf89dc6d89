// Estimates a small miss rate for faults of one size by importance sampling. The noise of records
// of faulty gearboxes is exponentially tilted towards misses
// (signals/windowing/noise_importance_sampler.hpp).
#pragma once

#include <optional>
#include <string>

#include "analysis/detection/importance_sample.hpp"
#include "mc/ensemble/ensemble_run.hpp"
#include "mc/scene/scene.hpp"

namespace gearpod::mc {

struct MissRateRequest {
    std::string feature;
    double threshold = 0.0;    // alarm threshold in the feature's unit
    double noise_level = 1.0;  // one of sensor.noise_levels
    double size = 0.0;         // fault size, SI
    long gearboxes = 0;
    int records = 0;  // per gearbox, a multiple of NoiseImportanceSampler::kKinds
};

// Study restricted to one of its features and one noise level.
Study of_feature(const Study& study, const std::string& feature, double noise_level);
// Study in which all test gearboxes have a fault of this size (SI). The other inputs keep their
// distributions.
Study with_fault(const Study& study, double size);
// Study restricted to the feature, noise level and fault size of the question, with its numbers of
// gearboxes and records.
Study study_for_miss_rate(const Study& study, const MissRateRequest& request);

struct MissRateResult {
    // Miss rate; empty if too few gearboxes contribute to it.
    std::optional<analysis::ImportanceSample::Estimate> misses;
    long gearboxes = 0, failed = 0;
    long records = 0;  // number computed
    // Number of plain records, one per gearbox, that would give the same standard error. NaN
    // without `misses`, or if all faults are missed.
    double counted = 0.0;
};

// Reason why a run of batches has no result, or "".
std::string failure_reason(const EnsembleOutcome& outcome);
// Sample size of plain counting that gives this relative variance of a rate; NaN for a rate of 1.
double equivalent_sample_size(double rate, double variance);

// Every rank must call it with the scene of study_for_miss_rate(); only rank 0 gets the result.
// Throws std::runtime_error if a batch fails or the run is interrupted.
MissRateResult estimate_miss_rate(const Scene& scene, const MissRateRequest& request,
                                  const Ranks& ranks, Progress& progress,
                                  const Interruption* interruption = nullptr);

}  // namespace gearpod::mc
