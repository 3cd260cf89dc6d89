// Sentences for readers of results: a study's modelling assumptions, and its false alarms in time.
#pragma once

#include <optional>
#include <string>

#include "mc/study/study.hpp"

namespace gearpod::mc {

// Text that begins "These results hold for a crack in planet 1, ...": `fault` (what and where), the
// idealizations of the simulated gearboxes, the inputs that do not vary, and their effect on the
// results. `lives`: for the lives of gearboxes with a growing crack, otherwise for a run, in which
// no crack grows. Empty for a study without gears.
std::string assumptions(const Study& study, bool lives, const std::string& fault = "");

// " (chosen)" if the study names the key in detection.chosen_values, else "".
std::string chosen_mark(const Study& study, const std::string& key);

// Target of false alarms in the user's units, as a rate of one record.

// True if the study gives false alarms in time, not as a rate of a record.
bool has_alarm_target(const Study& study);

// False alarms of all machines per hour.
double alarm_target_per_hour(const Study& study);

// Hours between two records of a machine; empty if the study does not give them.
std::optional<double> record_interval_h(const Study& study);

// Sentence on the false-alarm rate in time: "1 false alarm a year ... is a rate of 1.1e-4"; without
// a target, how many false alarms a year the rate gives. "" if the time between records is unknown.
std::string false_alarm_target_text(const Study& study);

}  // namespace gearpod::mc
