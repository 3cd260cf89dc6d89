#include "mc/accuracy/rung_scenes.hpp"

namespace gearpod::mc {

RungScenes::RungScenes(const Study& study)
    : own_(study), last_(std::make_unique<const Scene>(own_)) {}

const Scene& RungScenes::of(const Rung& rung) {
    const Numerics numerics = with_rung(own_.study(), rung).numerics;
    if (numerics.grid == StepGrid::graded) {
        settled_ = std::make_unique<const Scene>(graded(rung).with(numerics));
        return *settled_;
    }
    last_ = std::make_unique<const Scene>(last_->with(numerics));
    return *last_;
}

// The convergence tolerance does not affect the grid.
const Scene& RungScenes::graded(const Rung& rung) {
    Rung grid = rung;
    grid.settle_tolerance = own_.study().numerics.settle_tolerance;
    auto& scene = graded_[grid.text()];
    if (scene == nullptr) {
        scene = std::make_unique<const Scene>(own_.with(with_rung(own_.study(), grid).numerics));
    }
    return *scene;
}

}  // namespace gearpod::mc
