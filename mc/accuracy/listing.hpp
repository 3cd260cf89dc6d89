// The rungs that `accuracy` measures before it knows anything of their errors.
#pragma once

#include <string>
#include <vector>

#include "mc/numerics/rung.hpp"

namespace gearpod::mc {

struct ListedRung {
    Rung rung;
    std::string refusal;  // why it is not marched
};

// The study with integrator and steps left to the program.
Study without_steps(const Study& study);

// The study's own rung first; all equal steps and graded grids at the tightest settling; last the
// own rung with every mesh marched.
std::vector<ListedRung> listed_rungs(const Study& study);

}  // namespace gearpod::mc
