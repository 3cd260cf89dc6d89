// Samples of a scene's records, which are folded over planet turns, and records that are shorter
// than the span: part of a gearbox's signals, from a random tooth position.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "mc/ensemble/coupling/record_positions.hpp"
#include "mc/ensemble/gearbox/gearbox_tile.hpp"
#include "mc/plan/scene.hpp"

namespace gearpod::mc {

// Mean time between samples in a gearbox with these inputs, s.
double sample_s(const Scene& scene, const InstanceInputs& inputs);

// Samples in a turn of the monitored gear.
std::size_t turn_samples(const Scene& scene);

// Part of a signal that is folded: the record's turns, or the span. The signal may continue after
// it.
std::span<const double> folded_part(const Scene& scene, const LaneSignals& record,
                                    std::span<const double> samples);

// Folded squares of samples of a record or of whole signals, as LaneSignals::folded.
std::vector<double> folded_squares(const Scene& scene, const LaneSignals& record,
                                   std::span<const double> samples);
// Folds a record's sensor samples again after a change.
void fold_again(const Scene& scene, LaneSignals& record);

// Record cut from signals of scene.signal_meshes() mesh periods: sensor samples (if `samples`),
// folded squares and averaged transmission error, all from the window's first mesh period on.
LaneSignals cut_record(const Scene& scene, const LaneSignals& signals, const RecordWindow& window,
                       bool samples);

// The record of a gearbox with its samples: cut at random if records have a length, or else the
// whole signals.
LaneSignals drawn_record(const Scene& scene, LaneSignals signals, const Realization& realization);

// Rotates values of a turn, `per_mesh` for each mesh period, so that they begin with tooth 0.
void rotate_to_first_tooth(const LaneSignals& record, int per_mesh, std::vector<double>& turn);

// Conditions for which the results of `run` hold: assumptions(), the length of a record, the part
// of the faulty tooth's meetings that it contains, and the baseline.
std::string run_conditions(const Study& study);

// Length of a record at nominal speed, for example "10 s, 7 turns of 39 mesh periods".
std::string record_length_text(const Scene& scene);

}  // namespace gearpod::mc
