#include "mc/plan/scene.hpp"

#include <algorithm>
#include <stdexcept>

#include "mc/plan/stage_plan.hpp"
#include "mc/study/gears.hpp"

namespace gearpod::mc {
namespace {

const Study& with_gears(const Study& study) {
    if (!has_gears(study)) {
        throw std::invalid_argument("a scene needs tooth numbers and a module");
    }
    return study;
}

}  // namespace

bool share_steps(Numerics a, const Numerics& b) {
    a.convergence_tolerance = b.convergence_tolerance;
    a.tolerance = b.tolerance;
    a.scatter_tolerance = b.scatter_tolerance;
    return a == b;
}

Scene::Scene(const Study& study)
    : study_(with_gears(study)),
      ensemble_(std::make_shared<const EnsemblePlan>(study)),
      sampler_(std::make_shared<const Sampler>(DrawPlan(study))) {
    auto gearbox = std::make_shared<GearboxPlan>(study);
    auto steps = std::make_shared<const ScenePlan>(make_plan(study, *sampler_, *gearbox));
    stages_ = std::make_shared<const std::vector<Scene>>(stage_scenes(study));
    gearbox->stages = make_stages(study, *gearbox, stages_);
    gearbox_ = std::move(gearbox);
    features_ = make_feature_plan(study, drivetrain().span());
    const int samples = steps->integration.grid.samples;
    sensors_ = std::make_shared<const std::vector<SensorPlan>>(
        make_sensor_plans(study, drivetrain(), samples));
    record_ = make_record_plan(study, *gearbox_, features_, *sensors_, samples, steps->te_samples);
    solve_ = std::make_shared<const SolvePlan>(SolveSettings(study), *gearbox_, record_,
                                               std::move(steps));
    plan_life();
}

void Scene::plan_life() {
    life_problems_ = mc::life_problems(study_, features_, *gearbox_);
    if (life_problems_.empty()) {
        life_ = std::make_shared<const LifePlan>(make_life_plan(study_, *gearbox_));
    } else {
        life_ = nullptr;
    }
}

const LifePlan& Scene::life() const {
    if (!life_) {
        throw life_problems_.front();
    }
    return *life_;
}

Scene Scene::with(const Numerics& numerics) const {
    const Numerics& given = study_.numerics;
    const bool same_stiffness = given.stiffness_tolerance == numerics.stiffness_tolerance &&
                                given.face_slices == numerics.face_slices;
    Scene scene = *this;
    scene.study_.numerics = numerics;
    scene.ensemble_ = std::make_shared<const EnsemblePlan>(scene.study_);
    if (!same_stiffness) {
        auto gearbox = std::make_shared<GearboxPlan>(scene.study_);
        gearbox->stages = gearbox_->stages;
        scene.gearbox_ = std::move(gearbox);
    }
    const auto steps = share_steps(given, numerics)
                           ? solve_->steps
                           : std::make_shared<const ScenePlan>(
                                 make_plan(scene.study_, *sampler_, *scene.gearbox_));
    scene.solve_ = std::make_shared<const SolvePlan>(SolveSettings(scene.study_), *scene.gearbox_,
                                                     record_, steps);
    return scene;
}

Scene Scene::recording_at_most(int meshes) const {
    Scene scene = *this;
    scene.record_.recorded_meshes = std::min(record_.signal_meshes, meshes);
    scene.solve_ = std::make_shared<const SolvePlan>(solve_->settings, *gearbox_, scene.record_,
                                                     solve_->steps);
    return scene;
}

}  // namespace gearpod::mc
