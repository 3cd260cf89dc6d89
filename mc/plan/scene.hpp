// Whole plan of a study.
#pragma once

#include <memory>
#include <vector>

#include "mc/plan/ensemble_plan.hpp"
#include "mc/plan/life_plan.hpp"
#include "mc/plan/tile_plan.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

// True if plans with these numerics have the same steps: they differ at most in their tolerances.
bool share_steps(Numerics a, const Numerics& b);

// Everything that the gearboxes of a study have in common, computed once. Immutable. Copies, and
// scenes derived from it, share the parts that are equal.
class Scene {
  public:
    // The study has gears, and its numerics are resolved (resolve_numerics). Throws SceneError.
    explicit Scene(const Study& study);
    Scene(const Scene&) = default;
    Scene& operator=(const Scene&) = delete;

    // Scene of this study, which is that of the scene with other numerics. The stiffness is
    // recomputed only for another stiffness_tolerance; the steps are shared if
    // share_steps(). Throws SceneError.
    Scene with_numerics_of(const Study& study) const;

    const StudyLives& lives() const { return *lives_; }
    // Throws SceneError if there are none.
    const LifePlan& life() const;
    const EnsemblePlan& ensemble() const { return *ensemble_; }
    const TilePlan& tile() const { return tile_; }
    // Parts of tile().
    const Sampler& sampler() const { return *tile_.sampler; }
    const DrawPlan& draw() const { return tile_.draw(); }
    const GearboxPlan& gearbox() const { return *tile_.gearbox; }
    const SolvePlan& solve() const { return *tile_.solve; }
    const FeaturePlan& features() const { return tile_.features; }
    // The first sensor and the additional ones.
    const std::vector<SensorPlan>& sensors() const { return *tile_.sensors; }
    const RecordPlan& record() const { return tile_.record; }

  private:
    std::shared_ptr<const EnsemblePlan> ensemble_;
    TilePlan tile_;
    std::shared_ptr<const StudyLives> lives_;
};

// Studies of the neighbouring stages, with the speed of their common shafts and the sensor of the
// study. Only their vibration is used: they have no records and one feature. Throws SceneError.
std::vector<Study> stage_studies(const Study& study);

// Throws SceneError unless the steps of every stage suffice next to the slowest gearbox, and
// coupled stages can be integrated together: all by the central difference method in double
// precision with steps that are stable with the shafts, under steady loads of which every shaft
// bears a part.
void check_stages(const Study& study, const Scene& scene);

// Statements of stages that have no effect, as notices about the study named `file`.
Problems stage_notices(const Study& study, const std::string& file);

}  // namespace gearpod::mc
