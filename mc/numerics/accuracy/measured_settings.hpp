// Solver settings that `accuracy` measures first, before their errors are known.
#pragma once

#include <string>
#include <vector>

#include "mc/numerics/accuracy/report.hpp"
#include "mc/numerics/solver_setting.hpp"

namespace gearpod::mc {

struct ListedSetting {
    SolverSetting setting;
    std::string refusal;  // why it is not measured
};

// Numerics without a given integrator, number of steps, mass scaling and single precision.
Numerics without_setting(Numerics numerics);

// Settings to measure: the study's own first; then all uniform steps and graded grids with the
// tightest convergence tolerance; last the study's own with every mesh period integrated.
std::vector<ListedSetting> listed_settings(const Planner& planner);
bool integrates_every_mesh(const SolverSetting& setting);
// Index of a setting in `settings`; settings.size() if it is not among them.
std::size_t index_of(const SolverSetting& setting, const std::vector<SettingResult>& settings);

// Indices of `settings` from `from` on in the order of measurement: index 0 first, then by the cost
// model's time of a mesh period, those of unknown cost last.
std::vector<std::size_t> cheapest_first(const SolverFacts& facts,
                                        const std::vector<SettingResult>& settings,
                                        std::size_t from);

}  // namespace gearpod::mc
