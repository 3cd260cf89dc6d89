// Solver settings that `accuracy` measures first, before their errors are known.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mc/numerics/accuracy/report.hpp"
#include "mc/numerics/solver_setting.hpp"

namespace gearpod::mc {

struct ListedSetting {
    SolverSetting setting;
    std::string refusal;  // why it is not measured
};

// Study without a given integrator, number of steps, mass scaling and single precision.
Study without_setting(const Study& study);

// Settings to measure: the study's own first; then all uniform steps and graded grids with the
// tightest convergence tolerance; last the study's own with every mesh period integrated.
std::vector<ListedSetting> listed_settings(const Study& study);
bool integrates_every_mesh(const SolverSetting& setting);
// Index of a setting in `settings`; settings.size() if it is not among them.
std::size_t index_of(const SolverSetting& setting, const std::vector<SettingResult>& settings);

// Indices of `settings` from `from` on in the order of measurement: index 0 first, then by the cost
// model's time of a mesh period, those of unknown cost last.
std::vector<std::size_t> cheapest_first(const Study& study,
                                        const std::vector<SettingResult>& settings,
                                        std::size_t from);

// Scenes of the solver settings that are measured. They share equal parts, and there is one plan
// for each graded grid, because making one costs a pilot.

class SettingScenes {
  public:
    // Precondition: `study` has no numerics.tolerance. Throws SceneError.
    explicit SettingScenes(const Study& study);
    // Scene with the study's own numerics.
    const Scene& own() const { return own_; }
    // Scene of a setting, valid until the next call. Throws SceneError.
    const Scene& of(const SolverSetting& setting);

  private:
    const Scene& graded(const SolverSetting& setting);

    const Scene own_;
    // Last scene with uniform steps: the next setting often differs only in its convergence
    // tolerance.
    std::unique_ptr<const Scene> last_;
    std::vector<std::pair<SolverSetting, std::unique_ptr<const Scene>>> graded_;
    std::unique_ptr<const Scene> graded_scene_;  // last scene with a graded grid
};

}  // namespace gearpod::mc
