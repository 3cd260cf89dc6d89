// Schedule of the faulty tooth's passages through the gear pairs, and the resulting stiffness of
// all lanes.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "lockstep/plan/integration_plan.hpp"
#include "lockstep/plan/stiffness_nodes.hpp"
#include "lockstep/plan/tooth_pairs.hpp"
#include "machine/ids.hpp"
#include "stiffness/mesh_stiffness.hpp"

namespace gearpod::lockstep {

// Gear pairs that a faulty tooth passes through, and the phases at which it does.
//
// Sources: Liang (2016), section 3.4 (sun, planet's sun side, planet's ring side); Park et al.
// (2016), section V-A, Fig. 8 (a planet tooth that meets sun and ring).

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

// Inputs for integrating a faulty tile in addition to the plan: stiffness curves of the faulty
// tooth, or wear.
struct FaultCurves {
    const PairSet* pairs = nullptr;
    FaultPattern pattern;
    // [curve][lane]; null for a lane without a fault, whose healthy periodic orbit stays
    // bit-identical. The faults of all lanes have the same number of teeth.
    std::vector<std::vector<std::shared_ptr<const stiffness::FaultyMesh>>> curve;
    // MeshOverrides::wear of every mesh period.
    machine::AlignedVector wear = {};

    bool faulty(LaneId lane) const;
};

// Maps mesh periods to stiffness overrides and gaps. Keeps references: the arguments must outlive
// it.
class FaultSchedule {
  public:
    // `tooth_errors`: errors of single teeth, or null. Throws std::invalid_argument if there are
    // any but the plan has no single tooth pairs, and for wear of which it has no shape.
    FaultSchedule(const IntegrationPlan& plan, const FaultCurves& faults,
                  const ToothErrors* tooth_errors = nullptr);

    // Pairs whose stiffness the faulty tooth changes during mesh period k of the pattern.
    std::vector<PairOverride> overrides(int k) const;

    // Deviations that are the same in all mesh periods: wear.
    MeshOverrides periodic_overrides() const { return {{}, {}, faults_.wear}; }
    // The same with overrides(k).
    MeshOverrides pattern_overrides(int k) const { return {overrides(k), {}, faults_.wear}; }

    // Faults, wear and tooth errors of mesh period k of an integration; k may be any integer.
    // Caches the faults of each mesh period of the pattern, because these repeat; not thread-safe.
    MeshOverrides all_overrides(int k);

    // True if the faulty tooth is in contact during mesh period k, and if it still is at the end of
    // it. k may be any integer.
    bool passes(int k) const;
    bool continues_after(int k) const;

  private:
    int in_pattern(int k) const;
    std::optional<double> passage_start(const FaultPassage& passage, int k) const;
    double duration(const FaultPassage& passage) const {
        return duration_[static_cast<std::size_t>(passage.curve)];
    }
    PairOverride make_override(const FaultPassage& passage, int k, double start) const;
    void copy_healthy(LaneId lane, std::size_t lanes, PairOverride& o) const;

    const IntegrationPlan& plan_;
    const FaultCurves& faults_;
    const ToothErrors* const tooth_errors_;
    std::vector<double> duration_;  // of each curve, mesh periods; 0 if no lane has it
    std::map<int, std::vector<PairOverride>> cache_;  // cache, by mesh period of the pattern
};

}  // namespace gearpod::lockstep
