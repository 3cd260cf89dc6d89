// Sampling rate of a recording compared with the grid of a study.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "mc/scene/scene.hpp"

namespace gearpod::mc {

struct RecordedSignals {
    bool sensor = false, te = false;
};

// Problems of the number of samples per mesh period: too few to resolve the mesh frequency or the
// sensor's frequency range, or so many that the study's grid would alias high frequencies. `phase`
// has the mesh phase of every sample.
std::vector<std::string> rate_problems(std::span<const double> phase, const Scene& scene,
                                       RecordedSignals has);

}  // namespace gearpod::mc
