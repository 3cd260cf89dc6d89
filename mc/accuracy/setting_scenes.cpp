#include "mc/accuracy/setting_scenes.hpp"

#include <algorithm>

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
    grid.numerics.convergence_tolerance = own_.study().numerics.convergence_tolerance;
    const auto known = std::ranges::find(graded_, grid, [](const auto& one) { return one.first; });
    if (known != graded_.end()) {
        return *known->second;
    }
    auto scene =
        std::make_unique<const Scene>(own_.with(with_setting(own_.study(), grid).numerics));
    return *graded_.emplace_back(std::move(grid), std::move(scene)).second;
}

}  // namespace gearpod::mc
