// Settings and results of a tile.
#pragma once

#include <functional>
#include <vector>

#include "lockstep/plan/excitation.hpp"
#include "lockstep/plan/integration_plan.hpp"

namespace gearpod::lockstep {

enum class LaneStatus { ok, diverged, not_converged };

struct TileSettings {
    double tolerance = 1e-10;  // relative, of the state; criterion for convergence and decay
    int max_meshes = 200;      // limit for convergence to the periodic orbit, or for one decay
    int recorded_meshes = 0;   // 0: reuse the periodic orbit; otherwise: record this many
    // Mesh periods integrated before the recorded ones. With tooth errors, or an excitation that
    // does not repeat, no periodic orbit exists to start from. The tile then starts from the
    // periodic orbit without them.
    int run_in_meshes = 0;
    // Superposes the mesh periods of lanes whose tooth pairs all stay in contact from the effects
    // of each gear's errors (superposed_motion.hpp). Requires tooth errors and a steady excitation.
    bool superpose = false;
    // Also superposes lanes with a fault; the perturbation due to its passages is integrated from
    // the superposed states.
    bool superpose_faulty = false;
    bool with_motion = false;  // also records motions and mesh forces
    // Number of mesh periods, from the first, in which contact loss is counted; 0: one in
    // kContactMeshes.
    int contact_meshes = 0;
    // Keeps the state at the start of each fully integrated mesh period.
    bool keep_states = false;
    // States kept from the same gearboxes without faults and with the same settings, or null. If
    // given, only mesh periods that the faults change are integrated.
    const std::vector<TileState>* healthy = nullptr;
    // Receives the record of each fully integrated mesh period k in order, instead of keeping it.
    // Null: all records are kept.
    std::function<void(int k, const MeshRecord&)> on_record;
    // Time-varying excitation of these gearboxes, or null. An excitation that does not repeat every
    // mesh period requires recorded_meshes.
    const Excitation* excitation = nullptr;
};

// Content index without a record: the mesh period equals the healthy one to the tolerance, or its
// record went to `on_record`.
inline constexpr int kUnchanged = -1;

// Recorded mesh periods. Record 0 is the healthy one; mesh period k of the span has
// records[content[k mod L]]. With TileSettings::healthy, the records are those of the changed mesh
// periods. With `on_record`, only the healthy one is kept.
struct TileResult {
    std::vector<MeshRecord> records;
    std::vector<int> content;  // L = content.size()
    // kept states: before each integrated mesh period, and after the last
    std::vector<TileState> states;
    std::vector<LaneStatus> status;  // per lane
    // Per lane, with TileSettings::superpose: true if its healthy mesh periods were superposed.
    std::vector<char> superposed;
    // [gear pair][lane]: contact loss ratio, averaged over the tooth pairs. It is the fraction of a
    // tooth pair's engagement, within the nominal path of contact, in which it carries no load.
    // Counted in one of kContactMeshes mesh periods of the span including its faults
    // (tooth_contact.hpp), or as set by TileSettings::contact_meshes. If mesh periods repeat, it is
    // counted in the healthy one. Superposed mesh periods have no contact loss. Empty if teeth
    // cannot separate, and with TileSettings::healthy.
    machine::AlignedVector contact_loss;
    int integrated_meshes = 0;  // total number of mesh periods integrated or solved
};

}  // namespace gearpod::lockstep
