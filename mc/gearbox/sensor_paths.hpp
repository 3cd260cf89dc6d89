// Transmission paths of a scene's sensors.
#pragma once

#include <memory>
#include <vector>

#include "mc/scene/scene.hpp"
#include "signals/path/transmission_path.hpp"
#include "signals/sensor/sensor_response.hpp"

namespace gearpod::mc {

// Path through the window, then for each of ring_modes() the loads along x and y, then that of each
// of housing_bearings().
using SensorPath = std::vector<signals::PathGrid>;
// Paths of the first sensor and of the additional ones.
using SensorPaths = std::vector<SensorPath>;

SensorPaths sensor_paths(const Scene& scene);

// Recorders of a tile's sensor signals, one for each path of each sensor.
using SensorRecorders = std::vector<std::vector<std::unique_ptr<signals::SensorResponse>>>;

}  // namespace gearpod::mc
