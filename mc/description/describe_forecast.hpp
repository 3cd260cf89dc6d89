// What `describe` says of the time and memory of a run.
#pragma once

#include "mc/scene/scene.hpp"

namespace gearpod::mc {

// Computes some gearboxes and tries the analysis, for a few seconds at most, and prints what a run
// of this study is going to take in this process, and in `ranks` such processes unless that is 0.
// `setup_s`: what starting the program and making the scene took.
void print_forecast(const Scene& scene, double setup_s, int ranks);

}  // namespace gearpod::mc
