// Finds values of a study's inputs for which its simulated healthy gearboxes resemble measured
// ones. Python does this by approximate Bayesian computation on features
// (analysis/python/gearpod/calibration.py), with sets of two rounds that are simulated here: first
// over the whole prior, then as many in the region of the first posterior.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "mc/recordings/calibration/healthy_records.hpp"
#include "mc/recordings/calibration/simulated_sets.hpp"

namespace gearpod::mc {

inline constexpr int kCalibrationRounds = 2;

struct CalibrationTask {
    std::vector<CalibratedInput> inputs;
    HealthySet measured;
    std::size_t integrated = 200, backgrounds = 8;  // in each round
    std::string study;                              // text without distributions of the inputs
    std::uint64_t seed = 0;
};

struct CalibrationResult {
    nlohmann::ordered_json json;  // content of `calibrate --json`
    std::string text;             // table of the inputs and table of the compared features
    // TOML with the posterior sample as distributions of the inputs, in rows; comments give the
    // uncertainty.
    std::string study;
};

// Throws std::runtime_error if Python or numpy is missing.
void check_calibration_python();

// Runs both rounds. `simulate` returns the sets of one round (simulate_sets). `first`: first round
// of another task that differs only in the measured values. If it is empty, the first round is
// simulated and stored there. Throws std::runtime_error if too few sets can be simulated.
using SimulateRound = std::function<std::vector<SimulatedSet>(const PriorRegion&, const SetPlan&)>;
CalibrationResult calibrate(const CalibrationTask& task, std::vector<SimulatedSet>& first,
                            const SimulateRound& simulate);

}  // namespace gearpod::mc
