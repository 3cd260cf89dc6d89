// Solver settings that `accuracy` measures first, before their errors are known.
#pragma once

#include <string>
#include <vector>

#include "mc/accuracy/report.hpp"
#include "mc/numerics/rung.hpp"

namespace gearpod::mc {

struct ListedRung {
    Rung rung;
    std::string refusal;  // why it is not measured
};

// Study without a given integrator and number of steps.
Study without_steps(const Study& study);

// Settings to measure: the study's own first; then all uniform steps and graded grids with the
// tightest convergence tolerance; last the study's own with every mesh period integrated.
std::vector<ListedRung> listed_rungs(const Study& study);
bool marches_everything(const Rung& rung);
// Index of a setting in `rungs`; rungs.size() if it is not among them.
std::size_t place_of(const Rung& rung, const std::vector<RungResult>& rungs);

// Indices of `rungs` from `from` on in the order of measurement: index 0 first, then by the cost
// model's time of a mesh period, those of unknown cost last.
std::vector<std::size_t> cheapest_first(const Study& study, const std::vector<RungResult>& rungs,
                                        std::size_t from);

}  // namespace gearpod::mc
