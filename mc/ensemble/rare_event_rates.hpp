// Estimates small rates of misses and false alarms. For misses due to noise, the noise of records
// of faulty gearboxes is exponentially tilted towards misses
// (signals/windowing/noise_importance_sampler.hpp); for rates due to gearbox-to-gearbox variation,
// the random inputs are sampled by multilevel splitting (analysis/detection/splitting.hpp).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/detection/importance_sample.hpp"
#include "analysis/detection/splitting.hpp"
#include "machine/fields.hpp"
#include "mc/ensemble/ensemble.hpp"
#include "mc/plan/study_facts.hpp"

namespace gearpod::mc {

struct MissRateResult {
    // Miss rate; empty if too few gearboxes contribute to it.
    std::optional<analysis::ImportanceSample::Estimate> misses;
    long gearboxes = 0, failed = 0;
    long records = 0;  // number computed
    // Number of plain records, one per gearbox, that would give the same standard error. NaN
    // without `misses`, or if all faults are missed.
    double counted = 0.0;
};

// Every rank must call it with the plans of miss_rate_text(); only rank 0 gets the result.
// Throws std::runtime_error if a batch fails or the run is interrupted.
MissRateResult estimate_miss_rate(const TilePlan& tile, const EnsemblePlan& ensemble,
                                  const MissRateRequest& request, const Ranks& ranks,
                                  Progress& progress, const Interruption* interruption = nullptr);

// Lower limit of miss rates that are estimated.
inline constexpr double kSmallestMissRate = 1e-9;

// Random input whose distribution near an alarm or a miss differs from that of all gearboxes.
struct ShiftedInput {
    std::string name, unit;        // as in the column of the results
    double all = 0.0, rare = 0.0;  // means
};
GEARPOD_FIELDS(ShiftedInput, name, unit, mean_of_all, mean)

struct RareRateResult {
    // Empty if too few families reach the rare event.
    std::optional<analysis::SplitTail::Estimate> estimate;
    analysis::Interval threshold;   // confidence interval of the threshold for the false-alarm rate
    long computed = 0, failed = 0;  // number of gearboxes
    std::size_t levels = 0;
    double last_rate = 1.0;   // rate at which gearboxes fall into the last level
    double least_kept = 1.0;  // smallest fraction of accepted exchanges of a level
    // Number of gearboxes that plain counting needs for the same standard error; NaN without an
    // estimate.
    double counted = 0.0;
    std::vector<ShiftedInput> shifted;  // in the last level
};

// Largest number of gearboxes that estimate_rare_rate() computes.
long largest_gearbox_count(const RareRateRequest& request);

// Every rank must call it with the plans of rare_rate_text(); only rank 0 gets the result.
// Throws std::runtime_error if a batch fails or the run is interrupted.
RareRateResult estimate_rare_rate(const TilePlan& tile, const EnsemblePlan& ensemble,
                                  const RareRateRequest& request, const Ranks& ranks,
                                  Progress& progress, const Interruption* interruption = nullptr);

}  // namespace gearpod::mc
