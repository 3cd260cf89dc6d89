// Length of a record, and conditions under which records can be superposed.
#pragma once

#include <string>
#include <vector>

#include "mc/scene/feature_needs.hpp"
#include "mc/scene/scene.hpp"

namespace gearpod::mc {

// Length of a record in planet turns.
struct RecordSpan {
    int turns = 0;  // whole planet turns in each recording
    // planet turns after which every tooth of a planet has met every ring tooth once
    int all_turns = 0;
    int recordings = 1;  // number of recordings averaged in a record

    // True if every recording consists of complete spans.
    bool whole() const { return turns % all_turns == 0; }
};

// Length of a record at this speed. Throws SceneError if recordings are too short.
RecordSpan record_span(const Scene& scene, double speed_rad_s);

// Description of the length of a record and of the tooth pairs in it, for example "26 turns of
// ...".
std::string record_text(const Scene& scene);

// Needs of features in lives. Unlike in compared_needs(), a change is superposed without the
// samples of the record and of the baseline.
ComparedNeeds superposed_needs(std::span<const features::Feature* const> features);

// All reasons why the study's records cannot be superposed; empty if they can.
std::vector<SceneError> superposition_problems(const Scene& scene);
// Throws the first of them.
void check_superposable(const Scene& scene);

}  // namespace gearpod::mc
