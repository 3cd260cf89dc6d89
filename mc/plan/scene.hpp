// Data that all gearboxes of a study have in common, computed once: drive, stiffness curves, fault
// pattern, phase grid.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "mc/plan/ensemble_plan.hpp"
#include "mc/plan/life_plan.hpp"
#include "mc/plan/scene_error.hpp"
#include "mc/plan/tile_plan.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

// True if plans with these numerics have the same steps: they differ at most in their tolerances.
bool share_steps(Numerics a, const Numerics& b);

// Immutable. Copies, and scenes derived from it, share the parts that are equal.
class Scene {
  public:
    // The study has gears, and its numerics are resolved (resolve_numerics). Throws SceneError.
    explicit Scene(const Study& study);
    Scene(const Scene&) = default;
    Scene& operator=(const Scene&) = delete;

    // Scene of this study, which is that of the scene with other numerics. The stiffness is
    // recomputed only for another stiffness_tolerance or face_slices; the steps are shared if
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
    const Drivetrain& drivetrain() const { return *gearbox().drivetrain; }
    const std::vector<SceneMesh>& meshes() const { return gearbox().stiffness->meshes(); }
    const lockstep::PairSet& pairs() const { return gearbox().pairs(); }
    const SceneFault& fault() const { return gearbox().fault(); }
    const lockstep::IntegrationPlan& plan() const { return solve().integration(); }
    const lockstep::FaultPattern& pattern() const { return fault().pattern(); }
    // Gear pair that the first passage of the faulty tooth weakens, or -1.
    int faulty_pair() const { return gearbox().faulty_pair(); }
    // Gear pair faulty_pair() with the faulty tooth of that size; null if the size is 0.
    std::shared_ptr<const stiffness::FaultyMesh> faulty_mesh(double size) const {
        return fault().mesh(0, size);
    }
    // See SceneStiffness.
    const MemberArray<gears::DeviationScales>& tooth_scales() const {
        return gearbox().stiffness->tooth_scales();
    }

    const FeaturePlan& features() const { return tile_.features; }
    // The first sensor and the additional ones.
    const std::vector<SensorPlan>& sensors() const { return *tile_.sensors; }
    // What is recorded of every gearbox. Its values by earlier names:
    const RecordPlan& record() const { return tile_.record; }
    const signals::SpanLayout& span() const { return tile_.record.span; }
    int span_meshes() const { return tile_.record.span.meshes(); }
    int signal_meshes() const { return tile_.record.signal_meshes; }
    int recorded_meshes() const { return tile_.record.recorded_meshes; }
    int path_meshes() const { return tile_.record.path_meshes(); }
    int samples_per_mesh() const { return tile_.record.samples; }
    int te_samples_per_mesh() const { return tile_.record.te_samples; }
    double nominal_mesh_frequency_Hz() const { return gearbox().mesh_frequency_Hz; }
    // See Stepping.
    int least_steps() const { return solve().stepping().least; }
    double explicit_steps() const { return solve().stepping().explicit_steps; }
    double longest_step() const { return solve().stepping().longest_step; }
    // Calibration of the steps on a pilot sample; empty if there was none.
    const std::optional<Calibration>& calibration() const { return solve().steps->calibration; }
    double decay_meshes() const { return solve().stepping().decay_meshes; }
    // Largest number of mesh periods within which a gearbox must converge.
    int max_meshes() const { return solve().convergence.max_meshes; }
    // See SceneStiffness.
    std::vector<double> transitions() const { return gearbox().stiffness->transitions(); }
    std::vector<double> stiffest_pairs() const { return gearbox().stiffness->stiffest_pairs(); }
    const std::vector<double>& mean_pairs() const { return gearbox().stiffness->mean_pairs(); }

    dynamics::GearboxInputs inputs(const InstanceInputs& instance) const {
        return gearbox().inputs(instance);
    }

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
