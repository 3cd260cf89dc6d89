// Positions of records in the signals of their gearboxes, and which records are computed together
// because they share them.
#pragma once

#include <span>
#include <vector>

#include "lockstep/tile/tile.hpp"
#include "mc/plan/sampling.hpp"
#include "mc/plan/scene.hpp"

namespace gearpod::mc {

// Number of baseline records of a gearbox that are computed: one if their motion is the same.
std::size_t computed_baselines(const Study& study);

// Mesh periods of a gearbox's signals that a record contains.
struct RecordWindow {
    int turns = 0;       // whole turns of the monitored gear
    int first_mesh = 0;  // mesh period at which the record begins
};

// Number of turns in a record of a gearbox with these inputs if the study gives the length of its
// records. It follows from the gearbox's speed, but is at least kLeastRecordTurns.
int record_turns(const Scene& scene, const InstanceInputs& inputs);
// Random window of a record with this many turns. Every first mesh period of the signal that leaves
// room for the record is equally likely. Records of kSharedWindows gearboxes have the same one if
// the study shares_windows().
RecordWindow record_window(const Scene& scene, const GearboxId& id, int turns);

// Gearboxes whose records begin at the same mesh period: the most lanes of a tile.
inline constexpr std::uint64_t kSharedWindows = 16;
// True for records of given length in gearboxes that need every mesh period integrated. Independent
// of the numerics. Not for random or fluctuating speed, several records of each gearbox, elastic
// shafts, responses of a housing, or lives: these need more than one part of the signal.
bool shares_windows(const Study& study);
// True if records share windows or the positions of coupled stages (shared_records).
bool shares_positions(const Study& study);
// Number of the first of `ids`, at most `most`, whose records may be computed together because they
// share windows or positions of coupled stages. All, if nothing is shared.
std::size_t shared_records(const Study& study, std::span<const GearboxId> ids, std::size_t most);

// Mesh periods of the signals that these records need, each part after a run-in of its own. Those
// of a baseline record include the window of the test record if features compare both there.
std::vector<lockstep::SpanPart> parts_of_records(const Scene& scene,
                                                 std::span<const Realization> records);

// Gearboxes whose records have stages at the same positions: the most lanes of a coupled tile.
inline constexpr std::uint64_t kSharedPositions = 8;
// True for the same record of gearboxes that are in the same group of `together`.
bool share_positions(const GearboxId& a, const GearboxId& b,
                     std::uint64_t together = kSharedPositions);

}  // namespace gearpod::mc
