// Sources of vibration other than the study's gearbox: faulty rolling bearings and neighbouring
// stages.
#pragma once

#include <string>

#include "mc/study/study.hpp"

namespace gearpod::mc {

// Impulses per turn of the shaft if this part is faulty, from the bearing's geometry. With r =
// diameter_ratio cos(contact angle), and Z elements that roll without sliding: outer ring Z (1 - r)
// / 2, inner ring Z (1 + r) / 2, cage (1 - r) / 2, rolling element (1 - r^2) / diameter_ratio, as
// it meets both rings in every turn about its axis. T. A. Harris, Rolling Bearing Analysis.
double impulses_per_turn(const Bearing& bearing);
// Turns of the faulty part through the load zone per turn of the shaft; 0 for a constant load.
double load_turns_per_turn(const Bearing& bearing);

inline constexpr const char* kStagesKey = "sensor.stages";

// True if there are bearings or stages, which differ between the records of a gearbox.
bool has_other_sources(const Study& study);
// True if an elastic shaft couples a stage with the study's gearbox.
bool is_coupled(const Study& study);
// True if there are records of another fault than the study's.
bool has_other_fault(const Study& study);

// "outer ring of the sun's bearing"
std::string bearing_text(const Bearing& bearing);
// The other fault, "" without one: "a fault of the outer ring of a bearing of the sun"
std::string other_fault_text(const Study& study);

}  // namespace gearpod::mc
