// Finds values of a study's inputs for which its simulated healthy gearboxes resemble measured
// ones. Uses approximate Bayesian computation on features (analysis/calibration/regression_abc.hpp)
// in two rounds: first over the whole prior, then with as many sets in the region of the first
// posterior.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "mc/recordings/calibration/healthy_records.hpp"
#include "mc/recordings/calibration/simulated_sets.hpp"

namespace gearpod::mc {

inline constexpr int kCalibrationRounds = 2;

// Posterior of one input; values in the unit of its key.
struct InputPosterior {
    CalibratedInput input;
    double median = 0.0, low = 0.0, high = 0.0;  // and the 90 % interval
    double width_ratio = 1.0;  // width of the 90 % interval relative to that of the prior
    bool is_informed = false;  // true if the records contain information about the input
    std::vector<std::string>
        strongest_summaries;  // summaries most correlated with it, the strongest first
};

// Two inputs of which the records determine only a combination.
struct CorrelatedPair {
    std::size_t first = 0, second = 0;
    double correlation = 0.0;  // rank correlation of the posterior
};

// Feature of the records compared with that of the simulated records that resemble them most.
struct FeatureCheck {
    std::string name, unit;
    // means over the set; 98 % interval of the simulated means
    double measured = 0.0, low = 0.0, high = 0.0;
    bool outside() const { return measured < low || measured > high; }
};

struct CalibrationResult {
    std::vector<InputPosterior> found;
    // [input][draw]: equally likely samples of the joint posterior, in the units of the keys.
    std::vector<std::vector<double>> samples;
    std::vector<CorrelatedPair> pairs;
    std::vector<FeatureCheck> checks;
    std::size_t sets = 0, failed = 0;  // number simulated, and number of those without features
};

struct CalibrationTask {
    std::vector<CalibratedInput> inputs;
    RecordLengths lengths;
    RecordValues measured;                          // in the order of the summary's features
    std::size_t integrated = 200, backgrounds = 8;  // in each round
};

// Runs both rounds. `simulate` returns the sets of one round (simulate_sets). `first`: first round
// of another task that differs only in the measured values. If it is empty, the first round is
// simulated and stored there. Throws std::runtime_error if too few sets can be simulated.
using SimulateRound = std::function<std::vector<SimulatedSet>(const PriorRegion&, const SetPlan&)>;
CalibrationResult calibrate(const CalibrationTask& task, const SetSummary& summary,
                            std::vector<SimulatedSet>& first, const SimulateRound& simulate);

// Study file (TOML) with the posterior sample as distributions of the inputs in [random]. The
// sample is stored in rows; comments give the uncertainty. `study`: text of the study without
// distributions of the inputs. `intro`: comment lines at the top.
std::string calibrated_study(std::string study, const CalibrationResult& result,
                             const std::vector<std::string>& intro);

// Results of `calibrate` as text, as JSON and as the first comment of the calibrated study.

// Table of the inputs and table of the compared features.
std::string calibration_text(const CalibrationResult& result);

nlohmann::ordered_json calibration_json(const HealthySet& set, const CalibrationTask& task,
                                        const CalibrationResult& result);

// Comment lines of calibrated_study().
std::vector<std::string> calibration_intro(std::uint64_t seed, const HealthySet& set,
                                           const CalibrationResult& result);

}  // namespace gearpod::mc
