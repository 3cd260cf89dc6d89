// Samples of records, which are folded over planet turns, and records that are shorter
// than the span: part of a gearbox's signals, from a random tooth position.
#pragma once

#include <span>
#include <vector>

#include "mc/ensemble/coupling/record_positions.hpp"
#include "mc/ensemble/gearbox/gearbox_tile.hpp"
#include "mc/plan/record_plan.hpp"

namespace gearpod::mc {

// Part of a signal that is folded: the record's turns, or the span. The signal may continue after
// it.
std::span<const double> folded_part(const RecordPlan& plan, const LaneSignals& record,
                                    std::span<const double> samples);

// Folded squares of samples of a record or of whole signals, as LaneSignals::folded.
std::vector<double> folded_squares(const RecordPlan& plan, const LaneSignals& record,
                                   std::span<const double> samples);
// Folds a record's sensor samples again after a change.
void fold_again(const RecordPlan& plan, LaneSignals& record);

// Record cut from signals of plan.signal_meshes mesh periods: sensor samples (if `samples`),
// folded squares and averaged transmission error, all from the window's first mesh period on.
LaneSignals cut_record(const RecordPlan& plan, const LaneSignals& signals,
                       const RecordWindow& window, bool samples);

// The record of a gearbox with its samples: cut at random if records have a length, or else the
// whole signals.
LaneSignals drawn_record(const RecordPlan& plan, LaneSignals signals,
                         const Realization& realization);

// Rotates values of a turn, `per_mesh` for each mesh period, so that they begin with tooth 0.
void rotate_to_first_tooth(const LaneSignals& record, int per_mesh, std::vector<double>& turn);

}  // namespace gearpod::mc
