// A mesh period in parts of about as many steps each: between two of them a tile may stop, so that
// it marches what it has to know and no whole mesh periods around it.
#pragma once

#include <vector>

#include "lockstep/march.hpp"

namespace gearpod::lockstep {

struct MeshPart {
    MarchPlan plan;  // with the steps [first_step, last_step) of the whole one
    int first_step = 0, last_step = 0;
    int first_sample = 0, last_sample = 0;  // those that its steps record; last: one past
};

// `count` parts, or as many as there are steps. Throws std::invalid_argument for count < 1.
std::vector<MeshPart> mesh_parts(const MarchPlan& plan, int count);

}  // namespace gearpod::lockstep
