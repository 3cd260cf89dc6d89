// Simulates sets of records like the measured ones, at random values of the calibrated inputs. One
// time integration serves several values of the inputs on which it does not depend: background,
// gain and path exponent.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "mc/plan/calibration_plan.hpp"
#include "mc/plan/tile_plan.hpp"
#include "mc/recordings/calibration/healthy_records.hpp"

namespace gearpod::mc {

// Part of the prior from which values are sampled, as quantiles from 0 to 1.
struct PriorRegion {
    std::vector<double> low, high;  // for each input
};

// Size of a simulation.
struct SetPlan {
    // samples of the inputs of the time integration, each for all gearboxes
    std::size_t integrated = 0;
    std::size_t backgrounds = 1;  // samples of the other inputs for each of these
    std::size_t first = 0;  // number of the first integrated sample; determines the random numbers
};

struct SimulatedSet {
    std::vector<double> unit;     // quantile of each input in its prior
    std::size_t integration = 0;  // number of its integrated sample
    std::vector<double> values;   // [record][feature]; empty if a gearbox failed
};

// Simulates the sets of a plan. Each input must be random in the study of `tile`. `report_time` is
// called once, after the first tile, with the estimated time of one thread for all sets, s. The
// sets do not depend on the number of threads.
std::vector<SimulatedSet> simulate_sets(const TilePlan& tile,
                                        std::span<const CalibratedInput> inputs,
                                        const PriorRegion& region, const SetPlan& plan,
                                        const RecordLengths& lengths, const UsedFeatures& features,
                                        int threads,
                                        const std::function<void(double)>& report_time);

}  // namespace gearpod::mc
