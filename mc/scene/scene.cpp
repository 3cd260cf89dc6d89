#include "mc/scene/scene.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "mc/scene/excitation_checks.hpp"
#include "mc/scene/feature_needs.hpp"
#include "mc/study/gears.hpp"

namespace gearpod::mc {
namespace {

using std::numbers::pi;

constexpr int kAllMeshes = std::numeric_limits<int>::max();

const Study& with_gears(const Study& study) {
    if (!has_gears(study)) {
        throw std::invalid_argument("a scene needs tooth numbers and a module");
    }
    return study;
}

bool differ_only_in_convergence_tolerance(Numerics a, const Numerics& b) {
    a.convergence_tolerance = b.convergence_tolerance;
    return a == b;
}

std::vector<Scene> make_stages(const Study& study) {
    check_stages(study);
    std::vector<Scene> scenes;
    for (const NeighbourStage& stage : study.sensor.stages) {
        Study own = *stage.study;
        // Other gearboxes here are other gearboxes there.
        own.ensemble.seed = static_cast<std::int64_t>(
            fnv1a(stage.name, static_cast<std::uint64_t>(study.ensemble.seed)) >> 1);
        scenes.emplace_back(own);
    }
    return scenes;
}

}  // namespace

Scene::Scene(const Study& study)
    : Scene(study, std::make_shared<const Sampler>(study), make_drivetrain(with_gears(study)),
            nullptr, nullptr, nullptr, kAllMeshes) {}

Scene::Scene(Study study, SharedSampler sampler, std::shared_ptr<const Drivetrain> drivetrain,
             SharedStiffness stiffness, SharedPlan plan, SharedStages stages, int most_recorded)
    : study_(std::move(study)),
      sampler_(std::move(sampler)),
      drivetrain_(std::move(drivetrain)),
      stiffness_(stiffness ? std::move(stiffness)
                           : std::make_shared<const SceneStiffness>(study_, *drivetrain_)),
      plan_(plan ? std::move(plan)
                 : std::make_shared<const ScenePlan>(
                       make_plan(study_, *sampler_, *drivetrain_, *stiffness_))),
      stages_(stages ? std::move(stages)
                     : std::make_shared<const std::vector<Scene>>(make_stages(study_))),
      span_(drivetrain_->span()),
      nominal_mesh_frequency_Hz_(
          drivetrain_->mesh_frequency_rad_s(nominal_inputs(study_).speed_rad_s) / (2.0 * pi)),
      signal_meshes_(mc::signal_meshes(study_, span_, std::abs(nominal_mesh_frequency_Hz_))),
      most_recorded_(most_recorded),
      max_meshes_(study_.effects.quasi_static()
                      ? 1
                      : choose_max_meshes(study_, plan_->stepping.decay_meshes)) {}

Scene Scene::with(const Numerics& numerics) const {
    const Numerics& own = study_.numerics;
    const bool same_stiffness = own.stiffness_tolerance == numerics.stiffness_tolerance &&
                                own.face_slices == numerics.face_slices;
    const bool same_plan = differ_only_in_convergence_tolerance(own, numerics);
    Study study = study_;
    study.numerics = numerics;
    return {std::move(study),
            sampler_,
            drivetrain_,
            same_stiffness ? stiffness_ : nullptr,
            same_plan ? plan_ : nullptr,
            stages_,
            most_recorded_};
}

Scene Scene::with(const Life& life) const {
    Study study = study_;
    study.life = life;
    return {std::move(study), sampler_, drivetrain_, stiffness_, plan_, stages_, most_recorded_};
}

Scene Scene::recording_at_most(int meshes) const {
    return {study_, sampler_, drivetrain_, stiffness_, plan_, stages_, meshes};
}

}  // namespace gearpod::mc
