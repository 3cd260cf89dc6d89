// Which pairs a faulty tooth meets, and when.
//
// Sources: Liang (2016), section 3.4 (sun, planet's sun side, planet's ring side); Park et al.
// (2016), section V-A, Fig. 8 (a planet tooth that meets sun and ring).
#pragma once

#include <vector>

#include "lockstep/plan/stiffness_nodes.hpp"

namespace gearpod::lockstep {

// A faulty tooth's engagement in one pattern: during it the pair `pair`, healthy otherwise, has the
// stiffness of the lane's curve `curve` from phase `start` (mesh periods).
struct FaultPassage {
    int pair = 0;
    double start = 0.0;
    int curve = 0;
};

// The fault's repetition: passages in mesh periods [0, length + 1), ascending start; length is the
// number of meshes after which the same teeth of the faulty gear meet the same gear again.
struct FaultPattern {
    int length = 1;
    std::vector<FaultPassage> passages;
};

// A planetary train's planets, as its pairs see them.
struct PlanetTurns {
    // psi_n / 2 pi, ascending in [0, 1), the first 0.
    std::vector<double> position;
    int planets() const { return static_cast<int>(position.size()); }
};
PlanetTurns equal_planets(int planets);

// A sun or ring tooth meets all planets in turn, one turn past the carrier later again the first.
// The first tooth met is the one that engages with planet 1 in mesh period 0. Curve 0.
FaultPattern sun_fault_pattern(const PairSet& pairs, const PlanetTurns& planets, int sun_teeth);
FaultPattern ring_fault_pattern(const PairSet& pairs, const PlanetTurns& planets, int ring_teeth);

// A planet tooth meets the sun, or the ring, once a planet turn; on both sides, half a planet turn
// apart: by (Z_p - 1) / 2 meshes from pitch point to pitch point, since it leans on the sun with
// one flank and on the ring with the other; (Z_p + 1) / 2 if the planets turn the other way. Curve
// 0 is that of the sun side if there is one, and then curve 1 the ring side's. planet: 0 to N - 1.
enum class PlanetSide { sun, ring, both };
FaultPattern planet_fault_pattern(const PairSet& pairs, int planet, PlanetSide side,
                                  int planet_teeth);

// A tooth of one of a fixed-shaft pair's gears meets the other gear once a turn of its own. Curve
// 0.
FaultPattern shaft_fault_pattern(const PairSet& pairs, int teeth);

}  // namespace gearpod::lockstep
