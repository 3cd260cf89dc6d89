#include "mc/accuracy/rung_scenes.hpp"

namespace gearpod::mc {

RungScenes::RungScenes(const Study& study)
    : study_(study), scene_(std::make_unique<Scene>(study)) {}

const Scene& RungScenes::of(const Rung& rung) {
    const Numerics numerics = with_rung(study_, rung).numerics;
    Scene* scene = scene_.get();
    if (numerics.grid == StepGrid::graded) {
        // How closely orbits settle changes no grid.
        Rung grid = rung;
        grid.settle_tolerance = study_.numerics.settle_tolerance;
        auto& own = graded_[grid.text()];
        if (own == nullptr) {
            own = rung_scene(study_, grid);
        }
        scene = own.get();
    }
    scene->use(numerics);
    return *scene;
}

}  // namespace gearpod::mc
