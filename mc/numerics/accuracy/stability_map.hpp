// Stability map of a study: steps per mesh period at which each integrator is stable, over the
// stiffness of the meshes.
#pragma once

#include <string>
#include <vector>

#include "machine/fields.hpp"
#include "mc/plan/planner.hpp"

namespace gearpod::mc {

struct StabilityCurve {
    std::string integrator;
    std::vector<double> steps;  // fewest stable ones, by factor
};
GEARPOD_FIELDS(StabilityCurve, integrator, steps)

// The gearbox with one of the properties that tests/hard examines.
struct HardCase {
    std::string name;
    std::vector<double> steps;  // fewest stable ones, by curve of the map
};
GEARPOD_FIELDS(HardCase, name, steps)

struct StabilityMap {
    std::vector<double> factors;         // on the largest stiffness of every gear pair
    std::vector<StabilityCurve> curves;  // of explicit integrators
    std::vector<HardCase> hard;          // at the study's own mesh stiffness
    std::vector<std::string> implicit;   // integrators that are stable everywhere
    std::string own;                     // the study's integrator
    double own_steps = 0.0;
};

// Gearbox of which a map is made: the nominal one, with the largest stiffness of every gear pair.
struct StabilityCase {
    dynamics::GearboxLayout layout;
    dynamics::GearboxInputs nominal;
    std::vector<double> stiffest_pairs;
};
// Bearings and masses stay; mesh damping follows the study's law. `own`: integrator and steps of
// the study.
StabilityMap stability_map(const StabilityCase& gearbox, const PlannedSteps& own);

}  // namespace gearpod::mc
