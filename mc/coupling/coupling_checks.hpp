// Conditions under which neighbouring stages can be computed.
#pragma once

#include "mc/scene/scene.hpp"

namespace gearpod::mc {

// Throws SceneError unless the steps of every stage suffice next to the slowest gearbox, and
// coupled stages can be integrated together: all by the central difference method in double
// precision with steps that are stable with the shafts, under steady loads of which every shaft
// bears a part.
void check_stages(const Scene& scene);

}  // namespace gearpod::mc
