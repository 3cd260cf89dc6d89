// Gap between the flanks of a tooth pair before and after its nominal path of contact.
//
// While both gears turn at their exact ratio, the tip corner of one tooth clears its mate's
// involute flank outside the path of contact. Before the path these are the corner of gear 2 and
// the flank of gear 1, after it the corner of gear 1 and the flank of gear 2. The gap is the
// distance along the line of action by which the gear with the flank would have to turn to close
// it. It grows with the square of the distance from the path. Deflected gears close it early and
// open it late (corner contact, extended contact): Munro, Morrish and Palmer (1999), Proc. IMechE C
// 213, 543-557; Singh and Houser (1990), AGMA 90-FTM; Lin, Wang, Oswald and Coy (1993), NASA TM
// 106174.
//
// Assumptions: the corner is sharp, the flank continues as an involute (radially below its base
// circle), and the force keeps the direction of the line of action.
#pragma once

#include "gears/mesh_geometry.hpp"

namespace gearpod::gears {

// Gap of a tooth pair, m, tau mesh periods after the start of its nominal path of contact; 0 on the
// path, 0 <= tau <= contact ratio.
double corner_gap(const MeshGeometry& mesh, double tau);

// Distances before the start and after the end of the path, in mesh periods, at which the corner
// gap reaches a given size.
struct CornerReach {
    double before = 0, after = 0;
};

// At most kLongestReach on either side. gap_m >= 0.
inline constexpr double kLongestReach = 0.45;
CornerReach corner_reach(const MeshGeometry& mesh, double gap_m);

}  // namespace gearpod::gears
