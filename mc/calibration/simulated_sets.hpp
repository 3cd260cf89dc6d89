// Sets of records as the measured ones, simulated at drawn values of the calibrated inputs. A march
// serves several draws of what it does not depend on: background, gain, path exponent.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "mc/calibration/parameters.hpp"
#include "mc/calibration/record_sets.hpp"
#include "mc/scene/scene.hpp"

namespace gearpod::mc {

// Of the prior, as places in it from 0 to 1: where draws are taken.
struct PriorRegion {
    std::vector<double> low, high;  // by input
};

// How much is simulated.
struct DrawPlan {
    std::size_t marched = 0;      // draws of what is marched, each of all gearboxes
    std::size_t backgrounds = 1;  // draws of the rest for each
    std::size_t first = 0;        // number of the first marched draw: others have other numbers
};

struct SimulatedSet {
    std::vector<double> unit;     // place of each input in its prior
    std::size_t march = 0;        // number of its marched draw
    std::vector<double> summary;  // empty if a gearbox failed or a feature has no value
};

// What the scene's study and the inputs must agree in: each input is random in the study. `told` is
// called once, after the first tile, with the seconds that one thread will need for all. The sets
// are the same for any number of threads.
std::vector<SimulatedSet> simulate_sets(const Scene& scene, std::span<const CalibratedInput> inputs,
                                        const PriorRegion& region, const DrawPlan& plan,
                                        const RecordLengths& lengths, const SetSummary& summary,
                                        int threads, const std::function<void(double)>& told);

// The features of one set: the records of simulated gearboxes with `given` inputs, whose random
// numbers are those of set `number`. Empty if a gearbox failed.
RecordValues simulate_set(const Scene& scene, std::span<const GivenInput> given, std::size_t number,
                          const RecordLengths& lengths, const SetSummary& summary);

}  // namespace gearpod::mc
