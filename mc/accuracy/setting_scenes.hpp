// Scenes of the solver settings that are measured. They share equal parts, and there is one plan
// for each graded grid, because making one costs a pilot.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "mc/numerics/solver_setting.hpp"

namespace gearpod::mc {

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
