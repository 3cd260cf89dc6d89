// When a faulty tooth passes which pair, and the stiffness that the lanes then see.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "lockstep/plan/fault_pattern.hpp"
#include "lockstep/plan/march.hpp"
#include "lockstep/plan/tooth_errors.hpp"
#include "stiffness/mesh_stiffness.hpp"

namespace gearpod::lockstep {

// What marching a tile needs besides the plan: the pairs' curves for the faulty tooth.
struct FaultCurves {
    const PairSet* pairs = nullptr;
    FaultPattern pattern;
    // [curve][lane]; a lane without a fault has none and keeps its healthy orbit to the bit. The
    // faults of all lanes have the same number of teeth.
    std::vector<std::vector<std::shared_ptr<const stiffness::FaultyMesh>>> curve;

    // Errors of single teeth; only with TileSettings::march_meshes.
    const ToothErrors* tooth_errors = nullptr;

    bool faulty(int lane) const;
};

// Valid as long as the plan and the faults it was made from.
class FaultSchedule {
  public:
    FaultSchedule(const MarchPlan& plan, const FaultCurves& faults);

    // The pairs whose stiffness the faulty tooth changes during mesh k of the pattern.
    std::vector<PairOverride> overrides(int k) const;

    // The same, and the tooth errors, during mesh k of a march; k counts from any integer. Keeps
    // the faults of a pattern's meshes, for those come again: not for several threads at once.
    MeshOverrides all_overrides(int k);

    // Is the faulty tooth in contact during mesh k, and still at its end? Likewise of a march.
    bool passes(int k) const;
    bool continues_after(int k) const;

  private:
    int in_pattern(int k) const;
    std::optional<double> passage_start(const FaultPassage& passage, int k) const;
    double duration(const FaultPassage& passage) const {
        return duration_[static_cast<std::size_t>(passage.curve)];
    }
    PairOverride make_override(const FaultPassage& passage, int k, double start) const;
    void keep_healthy(std::size_t lane, std::size_t lanes, PairOverride& o) const;

    const MarchPlan& plan_;
    const FaultCurves& faults_;
    std::vector<double> duration_;  // of each curve, mesh periods; 0 if no lane has it
    std::map<int, std::vector<PairOverride>> kept_;  // by mesh of the pattern
};

}  // namespace gearpod::lockstep
