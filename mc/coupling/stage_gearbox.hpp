// Gearboxes of neighbouring stages next to those of a study.
#pragma once

#include "mc/scene/scene.hpp"

namespace gearpod::mc {

// Gearbox of stage number `stage` next to the study's gearbox of a record, with the stage's fault
// if `faulty`. Torque and speed differ from their nominal values by the same factors as here; the
// torque of a coupled stage balances that of its shaft. Next to a nominal torque of 0 it has its
// own torque.
Realization stage_gearbox(const Scene& scene, std::size_t stage, const Realization& record,
                          bool faulty = false);

}  // namespace gearpod::mc
