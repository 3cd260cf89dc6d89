// What all gearboxes of a study share, made once: drive, stiffness curves, fault pattern, phase
// grid.
#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "mc/scene/drive.hpp"
#include "mc/scene/sampling.hpp"
#include "mc/scene/scene_error.hpp"
#include "mc/scene/scene_plan.hpp"
#include "mc/scene/scene_stiffness.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

// Never changes. A copy, and another scene made from it, shares with it what both have alike.
class Scene {
  public:
    // The study must have gears (has_gears). Its numerics are taken as they stand: what
    // numerics.tolerance asks for is chosen before (resolve_numerics). Throws SceneError.
    explicit Scene(const Study& study);
    Scene(const Scene&) = default;
    Scene& operator=(const Scene&) = delete;

    // The same gearboxes marched another way. Makes the stiffness anew for another
    // stiffness_tolerance only, and no plan where the settle_tolerance alone is another. Throws
    // SceneError.
    Scene with(const Numerics& numerics) const;
    // The same, of whose signal no more than so many meshes are recorded one by one; the signal
    // repeats them. For measuring what a march costs.
    Scene recording_at_most(int meshes) const;

    const Study& study() const { return study_; }
    const Drive& drive() const { return *drive_; }
    const std::vector<SceneMesh>& meshes() const { return stiffness_->meshes(); }
    const lockstep::PairSet& pairs() const { return stiffness_->pairs(); }
    const SceneFault& fault() const { return stiffness_->fault(); }
    const lockstep::MarchPlan& plan() const { return plan_->march; }
    const lockstep::FaultPattern& pattern() const { return fault().pattern(); }
    // The pair that the first passage of the faulty tooth weakens, or -1.
    int faulty_pair() const { return pattern().passages.empty() ? -1 : pattern().passages[0].pair; }
    // That pair with the faulty tooth of that size; null if it is 0.
    std::shared_ptr<const stiffness::FaultyMesh> faulty_mesh(double size) const {
        return fault().mesh(0, size);
    }
    // See SceneStiffness.
    const EachMember<gears::DeviationScales>& tooth_scales() const {
        return stiffness_->tooth_scales();
    }

    const signals::SpanLayout& span() const { return span_; }
    // The meshes after which every tooth of the monitored gear has met every tooth of its mate.
    int span_meshes() const { return span_.meshes(); }
    // Meshes of sensor signal that the study's features look at: the span, or more if the teeth of
    // the sun or the ring need it.
    int signal_meshes() const { return signal_meshes_; }
    // Meshes that are recorded one by one where every mesh is marched: those of the signal, but for
    // recording_at_most().
    int recorded_meshes() const { return std::min(signal_meshes_, most_recorded_); }
    // Meshes after which the path to the sensor repeats; 1 if none turns.
    int path_meshes() const { return span_.carrier_meshes; }
    // Samples of the sensor, and of the encoders, in one mesh period.
    int samples_per_mesh() const { return plan().grid.samples; }
    int te_samples_per_mesh() const { return plan_->te_samples; }
    double nominal_mesh_frequency_Hz() const { return nominal_mesh_frequency_Hz_; }
    // See Stepping.
    int least_steps() const { return plan_->stepping.least; }
    double explicit_steps() const { return plan_->stepping.explicit_steps; }
    // How a pilot calibrated the steps, if one did.
    const std::optional<Calibration>& calibration() const { return plan_->calibration; }
    double decay_meshes() const { return plan_->stepping.decay_meshes; }
    // Mesh periods in which a gearbox must settle.
    int max_meshes() const { return max_meshes_; }
    // See SceneStiffness.
    std::vector<double> transitions() const { return stiffness_->transitions(); }
    std::vector<double> stiffest_pairs() const { return stiffness_->stiffest_pairs(); }
    const std::vector<double>& mean_pairs() const { return stiffness_->mean_pairs(); }

    dynamics::GearboxInputs inputs(const InstanceInputs& instance) const {
        return gearbox_inputs(study_, *drive_, instance);
    }

  private:
    using SharedStiffness = std::shared_ptr<const SceneStiffness>;
    using SharedPlan = std::shared_ptr<const ScenePlan>;
    // Stiffness and plan are made where they are null.
    Scene(Study study, std::shared_ptr<const Drive> drive, SharedStiffness stiffness,
          SharedPlan plan, int most_recorded);

    Study study_;
    std::shared_ptr<const Drive> drive_;
    SharedStiffness stiffness_;
    SharedPlan plan_;
    signals::SpanLayout span_;
    double nominal_mesh_frequency_Hz_;
    int signal_meshes_;
    int most_recorded_;
    int max_meshes_;
};

}  // namespace gearpod::mc
