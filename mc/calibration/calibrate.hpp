// What values of a study's inputs make its simulated healthy gearboxes look like measured ones:
// approximate Bayesian computation on features (analysis/calibration/regression_abc.hpp), in two
// rounds: draws over the whole prior, then as many where the first round found anything.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mc/calibration/simulated_sets.hpp"

namespace gearpod::mc {

inline constexpr int kCalibrationRounds = 2;

// What one input turned out to be; values in its key's unit.
struct FoundInput {
    CalibratedInput input;
    double median = 0.0, low = 0.0, high = 0.0;  // and the 90 % interval
    double left = 1.0;                           // of the width of the prior's 90 % interval
    bool told = false;                           // whether the records say anything of it
    std::vector<std::string> deciding;           // summaries that go with it, the first the most
};

// Two inputs of which the records tell only a combination.
struct BoundPair {
    std::size_t first = 0, second = 0;
    double correlation = 0.0;  // rank, of the posterior
};

// A feature of the records beside that of the simulated ones that look most like them.
struct FeatureCheck {
    std::string name, unit;
    double measured = 0.0, low = 0.0, high = 0.0;  // means over the set; 98 % of the simulated
    bool outside() const { return measured < low || measured > high; }
};

struct CalibrationResult {
    std::vector<FoundInput> found;
    // [input][draw]: equally likely draws of all inputs together, in the keys' units.
    std::vector<std::vector<double>> draws;
    std::vector<BoundPair> pairs;
    std::vector<FeatureCheck> checks;
    std::size_t sets = 0, failed = 0;  // simulated; of these without features
};

struct CalibrationTask {
    std::vector<CalibratedInput> inputs;
    RecordLengths lengths;
    RecordValues measured;                       // by the summary's features
    std::size_t marched = 200, backgrounds = 8;  // of each round
    int threads = 1;
};

// `told`: what simulate_sets says, for each round. `first`: the first round of another task that
// differs in what was measured alone; if it is empty, it is simulated and kept there. Throws
// std::runtime_error if too few sets can be simulated.
CalibrationResult calibrate(const Scene& scene, const CalibrationTask& task,
                            const SetSummary& summary, std::vector<SimulatedSet>& first,
                            const std::function<void(double)>& told);

// A study that has the inputs in [random], by whatever distributions, with the draws of what was
// found in their place, in rows, as TOML with their uncertainty in comments. `intro`: lines for the
// top.
std::string calibrated_study(const Study& study, const CalibrationResult& result,
                             const std::vector<std::string>& intro);

}  // namespace gearpod::mc
