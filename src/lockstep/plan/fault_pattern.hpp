// Gear pairs that a faulty tooth passes through, and the phases at which it does.
//
// Sources: Liang (2016), section 3.4 (sun, planet's sun side, planet's ring side); Park et al.
// (2016), section V-A, Fig. 8 (a planet tooth that meets sun and ring).
#pragma once

#include <vector>

#include "lockstep/plan/stiffness_nodes.hpp"
#include "machine/ids.hpp"

namespace gearpod::lockstep {

// One engagement of the faulty tooth in the pattern. From phase `start` (mesh periods), `pair` has
// the stiffness of the lane's curve `curve` instead of the healthy one.
struct FaultPassage {
    PairId pair;
    double start = 0.0;
    int curve = 0;
};

// Repeating sequence of passages in mesh periods [0, length + 1), sorted by start. `length` is the
// number of mesh periods after which the same teeth of the faulty gear meet the same gear again.
struct FaultPattern {
    int length = 1;
    std::vector<FaultPassage> passages;
};

// Angular positions of a planetary train's planets.
struct PlanetPositions {
    // psi_n / 2 pi, ascending in [0, 1); the first is 0
    std::vector<double> position;
    int planets() const { return static_cast<int>(position.size()); }
};

// Patterns of a sun or ring tooth. It meets all planets in turn, and returns to the first one after
// one revolution relative to the carrier. The first passage is the engagement with planet 1 that
// starts in mesh period 0. All passages use curve 0.
FaultPattern sun_fault_pattern(const PairSet& pairs, const PlanetPositions& planets, int sun_teeth);
FaultPattern ring_fault_pattern(const PairSet& pairs, const PlanetPositions& planets,
                                int ring_teeth);

// Pattern of a planet tooth, which meets the sun, or the ring, once per planet revolution. With
// PlanetSide::both, the two engagements are half a revolution apart. From pitch point to pitch
// point that is (Z_p - 1) / 2 mesh periods, because the tooth loads opposite flanks on sun and
// ring. In the reversed sense it is (Z_p + 1) / 2. Curve 0 belongs to the sun side if it is
// included; the ring side then has curve 1. `planet` is 0 to N - 1.
enum class PlanetSide { sun, ring, both };
FaultPattern planet_fault_pattern(const PairSet& pairs, PlanetId planet, PlanetSide side,
                                  int planet_teeth);

// Pattern of a tooth of a fixed-shaft gear, which meets the mating gear once per revolution. It
// uses curve 0.
FaultPattern shaft_fault_pattern(const PairSet& pairs, int teeth);

}  // namespace gearpod::lockstep
