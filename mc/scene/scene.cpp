#include "mc/scene/scene.hpp"

#include <numbers>
#include <stdexcept>

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

bool differ_in_settling_alone(Numerics a, const Numerics& b) {
    a.settle_tolerance = b.settle_tolerance;
    return a == b;
}

}  // namespace

Scene::Scene(const Study& study)
    : Scene(study, make_drive(with_gears(study)), nullptr, nullptr, kAllMeshes) {}

Scene::Scene(Study study, std::shared_ptr<const Drive> drive, SharedStiffness stiffness,
             SharedPlan plan, int most_recorded)
    : study_(std::move(study)),
      drive_(std::move(drive)),
      stiffness_(stiffness ? std::move(stiffness)
                           : std::make_shared<const SceneStiffness>(study_, *drive_)),
      plan_(plan ? std::move(plan)
                 : std::make_shared<const ScenePlan>(make_plan(study_, *drive_, *stiffness_))),
      span_(drive_->span()),
      nominal_mesh_frequency_Hz_(
          drive_->mesh_frequency_rad_s(Sampler(study_).nominal().speed_rad_s) / (2.0 * pi)),
      signal_meshes_(meshes_needed(study_, span_, needs_of(used_features(study_)))),
      most_recorded_(most_recorded),
      max_meshes_(study_.effects.quasi_static()
                      ? 1
                      : choose_max_meshes(study_, plan_->stepping.decay_meshes)) {}

Scene Scene::with(const Numerics& numerics) const {
    const Numerics& own = study_.numerics;
    const bool same_stiffness = own.stiffness_tolerance == numerics.stiffness_tolerance &&
                                own.face_slices == numerics.face_slices;
    const bool same_plan = differ_in_settling_alone(own, numerics);
    Study study = study_;
    study.numerics = numerics;
    return {std::move(study), drive_, same_stiffness ? stiffness_ : nullptr,
            same_plan ? plan_ : nullptr, most_recorded_};
}

Scene Scene::recording_at_most(int meshes) const {
    return {study_, drive_, stiffness_, plan_, meshes};
}

}  // namespace gearpod::mc
