// When a faulty tooth passes which pair, and the stiffness that the lanes then see.
#pragma once

#include <optional>
#include <vector>

#include "lockstep/march.hpp"
#include "stiffness/cracked_pair.hpp"

namespace gearpod::lockstep {

// A faulty tooth's engagement in one pattern: it replaces a healthy tooth pair of `pair` from phase
// `start` (mesh periods) for a contact ratio.
struct FaultPassage {
    int pair = 0;
    double start = 0.0;
};

// The fault's repetition: passages in mesh periods [0, length), ascending start; length is the
// number of meshes after which the same teeth meet again (Z_p, Z_s or Z_r).
struct FaultPattern {
    int length = 1;
    std::vector<FaultPassage> passages;
};

// What marching a tile needs besides the plan: the pairs' curves for the faulty tooth.
struct FaultCurves {
    const PairSet* pairs = nullptr;
    FaultPattern pattern;
    // One per lane; a lane without a fault has none and keeps its healthy orbit to the bit.
    std::vector<std::optional<stiffness::CrackedToothCurve>> cracked;
};

// Valid as long as the plan and the faults it was made from.
class FaultSchedule {
  public:
    FaultSchedule(const MarchPlan& plan, const FaultCurves& faults)
        : plan_(plan), faults_(faults) {}

    // The pairs whose stiffness the faulty tooth changes during mesh k of the pattern.
    std::vector<PairOverride> overrides(int k) const;

    // Is the faulty tooth still in contact at the end of mesh k?
    bool continues_after(int k) const;

  private:
    std::optional<double> passage_start(const FaultPassage& passage, int k) const;
    PairOverride make_override(int pair, int k, double start) const;

    const MarchPlan& plan_;
    const FaultCurves& faults_;
};

}  // namespace gearpod::lockstep
