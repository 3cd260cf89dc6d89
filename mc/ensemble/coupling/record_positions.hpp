// Positions of records in the signals of their gearboxes, and which records are computed together
// because they share them.
#pragma once

#include <span>
#include <vector>

#include "lockstep/tile/tile.hpp"
#include "mc/plan/record_plan.hpp"
#include "mc/plan/sampling.hpp"

namespace gearpod::mc {

// Mesh periods of a gearbox's signals that a record contains.
struct RecordWindow {
    int turns = 0;       // whole turns of the monitored gear
    int first_mesh = 0;  // mesh period at which the record begins
};

// Random window of a record with this many turns. Every first mesh period of the signal that leaves
// room for the record is equally likely. Records of RecordPlan::same_window gearboxes have the same
// one.
RecordWindow record_window(const RecordPlan& plan, const GearboxId& id, int turns);

// True for the same record of gearboxes that are in the same group of `together`.
bool share_positions(const GearboxId& a, const GearboxId& b, std::uint64_t together);
// Number of the first of `ids`, at most `most`, whose records may be computed together because they
// share windows or positions of coupled stages. All, if nothing is shared.
std::size_t shared_records(const RecordPlan& record, std::span<const GearboxId> ids,
                           std::size_t most);

// Mesh periods of the signals that these records need, each part after a run-in of its own. Those
// of a baseline record include the window of the test record if features compare both there.
// `repeats`: number of records of each gearbox, which differ in GearboxId::repeat.
std::vector<lockstep::SpanPart> parts_of_records(const RecordPlan& plan,
                                                 const FeaturePlan& features,
                                                 std::span<const Realization> records,
                                                 std::size_t repeats = 1);

}  // namespace gearpod::mc
