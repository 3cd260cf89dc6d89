// What of a gearbox's turning a record takes in, and whether its records can be composed.
#pragma once

#include <string>

#include "mc/scene/scene.hpp"

namespace gearpod::mc {

// What a record takes in of its gearbox.
struct RecordSpan {
    int turns = 0;       // of a planet, whole ones, in each recording
    int all_turns = 0;   // in which every tooth of a planet meets every one of the ring once
    int recordings = 1;  // that a record averages

    // Whether every recording holds all of these, perhaps more than once.
    bool whole() const { return turns % all_turns == 0; }
};

// Of a record at such a speed. Throws SceneError for recordings that are too short.
RecordSpan record_span(const Scene& scene, double speed_rad_s);

// "26 turns of the planet, ...": how long a record of the study's gearbox is, and which pairs of
// teeth it sees.
std::string record_text(const Scene& scene);

// Throws SceneError for what records cannot be composed of.
void check_composable(const Scene& scene);

}  // namespace gearpod::mc
