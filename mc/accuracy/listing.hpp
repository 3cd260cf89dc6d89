// The rungs that `accuracy` measures before it knows anything of their errors.
#pragma once

#include <string>
#include <vector>

#include "mc/accuracy/report.hpp"
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
bool marches_everything(const Rung& rung);
// Behind the last if it is none of them.
std::size_t place_of(const Rung& rung, const std::vector<RungResult>& rungs);

// The places of `rungs` from `from` on: the first of all, then by the cost model's time of a mesh
// period, those of unknown cost last.
std::vector<std::size_t> cheapest_first(const Study& study, const std::vector<RungResult>& rungs,
                                        std::size_t from);

}  // namespace gearpod::mc
