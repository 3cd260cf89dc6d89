// Prints the forecast of a run's time and memory for `describe`.
#pragma once

#include "mc/scene/scene.hpp"

namespace gearpod::mc {

// Computes some gearboxes and their analysis, for a few seconds at most. Prints the estimated time
// and memory of a run in this process, and in `ranks` such processes unless that is 0.
// `setup_s`: time used to start the program and build the scene.
void print_forecast(const Scene& scene, double setup_s, int ranks);

// Peak memory of this process.
struct PeakMemory {
    double setup_bytes = 0.0;     // when the scene was built
    double computed_bytes = 0.0;  // while gearboxes were computed; 0 if they took no more
};

// Forecast from the numbers of gearboxes and time steps alone, where computing some gearboxes takes
// too long.
void print_step_forecast(const Scene& scene, const PeakMemory& memory);

}  // namespace gearpod::mc
