// Computes some gearboxes of a run again with its assumptions changed.
#pragma once

#include <functional>

#include "mc/plan/planner.hpp"
#include "mc/results/results_file.hpp"

namespace gearpod::mc {

// The study at half and at twice each assumption, and the number of healthy gearboxes, and of as
// many faulty ones, that a run computes of each. All take at most a fifth of the number of the
// run's gearboxes; assumptions for which that leaves too few are omitted, the last first. Empty
// without faults, and for tilted noise, whose rows have weights.
struct AssumptionPairs {
    std::vector<AssumptionVariant> variants;
    int pairs = 0;
};
AssumptionPairs assumption_pairs(const Planner& planner);

// Their rows, of gearboxes that the run has as well, with the same random numbers. `computed` is
// called with the number of gearboxes after each variant.
AssumptionRows assumption_rows(
    const Planner& planner, const std::function<void(long)>& computed = [](long) {});

}  // namespace gearpod::mc
