// Results of a tile.
#pragma once

#include <vector>

#include "lockstep/plan/integration_plan.hpp"

namespace gearpod::lockstep {

enum class LaneStatus { ok, diverged, not_converged };

// States of a tile before each mesh period of a run-in and a span, and after the last one.
struct SpanStates {
    int run_in_meshes = 0;
    std::vector<TileState> all;

    // State before mesh period k of the span; k is negative during the run-in.
    const TileState& before(int k) const {
        return all[static_cast<std::size_t>(k + run_in_meshes)];
    }
    TileState& before(int k) { return all[static_cast<std::size_t>(k + run_in_meshes)]; }
    int span_meshes() const { return static_cast<int>(all.size()) - 1 - run_in_meshes; }
};

// Content index without a record: the mesh period equals the healthy one to the tolerance, or its
// record went to RecordedSpan::on_record.
inline constexpr int kUnchanged = -1;

// Recorded mesh periods. Record 0 is the healthy one; mesh period k of the span has
// records[content[k mod L]]. Those of a fault perturbation are the changed mesh periods, without
// the healthy one; lanes that do not change in such a mesh period are NaN there. With
// RecordedSpan::on_record, only the healthy one is kept.
struct TileResult {
    std::vector<MeshRecord> records;
    std::vector<int> content;        // L = content.size()
    SpanStates states;               // empty unless RecordOptions::states is set
    std::vector<LaneStatus> status;  // per lane
    // Per lane of a superposed solution: true if its healthy mesh periods were superposed.
    std::vector<char> superposed;
    // [gear pair][lane]: contact loss ratio, averaged over the tooth pairs. It is the fraction of a
    // tooth pair's engagement, within the nominal path of contact, in which it carries no load.
    // Counted in the mesh periods of the span that RecordOptions::motion_meshes states, including
    // its faults (tooth_contact.hpp). If mesh periods repeat, it is counted in the healthy one.
    // Superposed mesh periods have no contact loss. Empty if teeth cannot separate, and for a fault
    // perturbation.
    machine::AlignedVector contact_loss;
    int integrated_meshes = 0;  // total number of mesh periods integrated or solved
};

}  // namespace gearpod::lockstep
