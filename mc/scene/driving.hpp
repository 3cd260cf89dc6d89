// Checks that a scene's integration plan can resolve the variable excitation of its gearboxes.
#pragma once

#include "lockstep/plan/march.hpp"
#include "mc/scene/drive.hpp"

namespace gearpod::mc {

// Throws SceneError if kernels are missing, or if steps or samples are too coarse for a
// fluctuation.
void check_driving(const Study& study, const Drive& drive, const lockstep::MarchPlan& plan);

}  // namespace gearpod::mc
