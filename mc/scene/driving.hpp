// Whether a scene's plan can march what drives its gearboxes unevenly.
#pragma once

#include "lockstep/plan/march.hpp"
#include "mc/scene/drive.hpp"

namespace gearpod::mc {

// Throws SceneError where kernels are missing, or where steps are too long to follow a fluctuation.
void check_driving(const Study& study, const Drive& drive, const lockstep::MarchPlan& plan);

}  // namespace gearpod::mc
