#include "mc/accuracy/setting_scenes.hpp"

namespace gearpod::mc {

SettingScenes::SettingScenes(const Study& study)
    : own_(study), last_(std::make_unique<const Scene>(own_)) {}

const Scene& SettingScenes::of(const SolverSetting& setting) {
    const Numerics numerics = with_setting(own_.study(), setting).numerics;
    if (numerics.grid == StepGrid::graded) {
        graded_scene_ = std::make_unique<const Scene>(graded(setting).with(numerics));
        return *graded_scene_;
    }
    last_ = std::make_unique<const Scene>(last_->with(numerics));
    return *last_;
}

// The convergence tolerance does not affect the grid.
const Scene& SettingScenes::graded(const SolverSetting& setting) {
    SolverSetting grid = setting;
    grid.convergence_tolerance = own_.study().numerics.convergence_tolerance;
    auto& scene = graded_[grid.text()];
    if (scene == nullptr) {
        scene = std::make_unique<const Scene>(own_.with(with_setting(own_.study(), grid).numerics));
    }
    return *scene;
}

}  // namespace gearpod::mc
