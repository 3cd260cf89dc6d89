// Settings and results of a tile.
#pragma once

#include <functional>
#include <vector>

#include "lockstep/plan/excitation.hpp"
#include "lockstep/plan/march.hpp"

namespace gearpod::lockstep {

enum class LaneStatus { ok, diverged, unsettled };

struct TileSettings {
    double tolerance = 1e-10;  // of the state, relative, when orbit or decay count as reached
    int max_meshes = 200;      // of one approach to the orbit or of one decay
    int march_meshes = 0;      // 0: reuse; else: record so many meshes one by one
    // Marched before them: with tooth errors, or an excitation that does not repeat, there is no
    // orbit to start from; the tile starts from the one without.
    int run_in_meshes = 0;
    // Of lanes whose tooth pairs all stay in contact: compose those meshes of what each gear's
    // errors do (composition.hpp). Only with tooth errors, driven evenly.
    bool compose = false;
    // Lanes with a fault too: what its passages change is marched from the composed states.
    bool compose_faulty = false;
    bool with_motion = false;  // record motions and mesh forces too
    // Contact loss counts in the first so many mesh periods; 0: in one of kContactMeshes.
    int contact_meshes = 0;
    // Of meshes that are marched one by one: keep the state at the beginning of each.
    bool keep_states = false;
    // States that were kept of the same gearboxes without faults and with the same settings, or
    // null: what the faults leave as it was is not marched again.
    const std::vector<TileState>* healthy = nullptr;
    // Takes the record of each mesh k that is marched one by one, in order; it is not kept then.
    // Null: all of them are.
    std::function<void(int k, const MeshRecord&)> hear;
    // What drives these gearboxes unevenly, or null. One that does not repeat every mesh period
    // needs march_meshes.
    const Excitation* excitation = nullptr;
};

// In place of a record: the mesh is as it was without faults, to the tolerance, or was heard.
inline constexpr int kUnchanged = -1;

// Recorded mesh periods: 0 is the healthy one; mesh k of the span shows records[content[k mod L]].
// With TileSettings::healthy the records are those of the changed meshes, with `hear` the healthy
// one alone.
struct TileResult {
    std::vector<MeshRecord> records;
    std::vector<int> content;        // L = content.size()
    std::vector<TileState> states;   // kept ones: before each marched mesh and after the last
    std::vector<LaneStatus> status;  // per lane
    // Per lane, with TileSettings::compose: its healthy meshes were composed, not marched.
    std::vector<char> composed;
    // [gear pair][lane]: the contact loss ratio, the share of its engagement within the nominal
    // path of contact in which a tooth pair carries no load, averaged over the tooth pairs. Counted
    // in one of kContactMeshes mesh periods of the span with its faults (tooth_contact.hpp), or as
    // TileSettings::contact_meshes states; where
    // mesh periods repeat, in the healthy one. Superposed meshes have none. Empty where teeth
    // cannot part, and with TileSettings::healthy.
    machine::AlignedVector contact_loss;
    int marched = 0;  // mesh periods that the tile marched or solved in all
};

}  // namespace gearpod::lockstep
