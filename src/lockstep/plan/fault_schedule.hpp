// Schedule of the faulty tooth's passages through the gear pairs, and the resulting stiffness of
// all lanes.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "lockstep/plan/fault_pattern.hpp"
#include "lockstep/plan/integration_plan.hpp"
#include "lockstep/plan/tooth_pairs.hpp"
#include "machine/ids.hpp"
#include "stiffness/mesh_stiffness.hpp"

namespace gearpod::lockstep {

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
