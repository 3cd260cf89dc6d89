// Transmission paths of a scene's sensors.
#pragma once

#include <vector>

#include "mc/scene/scene.hpp"
#include "signals/path/transmission_path.hpp"

namespace gearpod::mc {

struct SensorPaths {
    signals::PathGrid first;
    std::vector<signals::PathGrid> additional;  // of Sensor::additional
};

SensorPaths sensor_paths(const Scene& scene);

}  // namespace gearpod::mc
