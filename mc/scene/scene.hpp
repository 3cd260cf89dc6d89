// What all gearboxes of a study share, made once: drive, stiffness curves, fault pattern, phase
// grid.
#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "lockstep/plan/march.hpp"
#include "lockstep/plan/tooth_errors.hpp"
#include "lockstep/plan/transmission_error.hpp"
#include "mc/scene/drive.hpp"
#include "mc/scene/faults.hpp"
#include "mc/scene/grid.hpp"
#include "mc/scene/meshes.hpp"
#include "mc/scene/sampling.hpp"
#include "mc/scene/scene_error.hpp"
#include "mc/scene/stepping.hpp"
#include "mc/study/study.hpp"

namespace gearpod::mc {

struct NumericsChoice;  // mc/numerics/choice.hpp

class Scene {
  public:
    // The study must have gears (has_gears). With numerics.tolerance, its other numerics are chosen
    // here. Throws SceneError.
    explicit Scene(const Study& study);
    ~Scene();
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    // With the numerics that were chosen.
    const Study& study() const { return study_; }
    // How they were chosen; null without numerics.tolerance.
    const NumericsChoice* numerics_choice() const { return choice_.get(); }
    const Drive& drive() const { return *drive_; }
    const std::vector<SceneMesh>& meshes() const { return meshes_; }
    const lockstep::PairSet& pairs() const { return pairs_; }
    const SceneFault& fault() const { return *fault_; }
    const lockstep::MarchPlan& plan() const { return plan_; }
    const lockstep::FaultPattern& pattern() const { return fault_->pattern(); }
    // The pair that the first passage of the faulty tooth weakens, or -1.
    int faulty_pair() const { return pattern().passages.empty() ? -1 : pattern().passages[0].pair; }
    // That pair with the faulty tooth of that size; null if it is 0.
    std::shared_ptr<const stiffness::FaultyMesh> faulty_mesh(double size) const {
        return fault_->mesh(0, size);
    }
    // Of the pitch errors of single teeth; null without them.
    const lockstep::LoadShares* load_shares() const { return load_shares_.get(); }

    const signals::SpanLayout& span() const { return span_; }
    // The meshes after which every tooth of the monitored gear has met every tooth of its mate.
    int span_meshes() const { return span_.meshes(); }
    // Meshes of sensor signal that the study's features look at: the span, or more if the teeth of
    // the sun or the ring need it.
    int signal_meshes() const { return signal_meshes_; }
    // Meshes that are recorded one by one where every mesh is marched: those of the signal, but for
    // record_at_most().
    int recorded_meshes() const { return std::min(signal_meshes_, most_recorded_); }
    // Records no more than so many of them from now on; the signal repeats them. For measuring what
    // a march costs.
    void record_at_most(int meshes) { most_recorded_ = meshes; }
    // Meshes after which the path to the sensor repeats; 1 if none turns.
    int path_meshes() const { return span_.carrier_meshes; }
    // Samples of the sensor, and of the encoders, in one mesh period.
    int samples_per_mesh() const { return plan_.grid.samples; }
    int te_samples_per_mesh() const { return te_samples_; }
    double nominal_mesh_frequency_Hz() const { return nominal_mesh_frequency_Hz_; }
    // See Stepping.
    int least_steps() const { return stepping_.least; }
    double explicit_steps() const { return stepping_.explicit_steps; }
    // How a pilot calibrated the steps, if one did.
    const std::optional<Calibration>& calibration() const { return calibration_; }
    double decay_meshes() const { return stepping_.decay_meshes; }
    // Mesh periods in which a gearbox must settle.
    int max_meshes() const { return max_meshes_; }
    // Marches the same gearboxes another way from now on. Throws SceneError.
    void use(const Numerics& numerics);
    // Phases in [0, 1) on which steps must end.
    std::vector<double> transitions() const;
    // All pairs at their stiffest: the bound for the integrator's step.
    std::vector<double> stiffest_pairs() const;
    // Every pair's mean over the mesh period, N/m.
    const std::vector<double>& mean_pairs() const { return mean_pairs_; }

    dynamics::GearboxInputs inputs(const InstanceInputs& instance) const {
        return gearbox_inputs(study_, *drive_, instance);
    }

  private:
    void build_stiffness();
    void build_plan();
    // The plan with its steps: stiffness and transmission errors at their nodes.
    lockstep::MarchPlan plan_of(lockstep::PhaseGrid grid) const;
    lockstep::Pilot pilot() const;
    // Static transmission errors of the kinds of mesh.
    lockstep::MeshError first_errors() const;
    lockstep::MeshError second_errors() const;
    void settle();

    Study study_;
    std::unique_ptr<const NumericsChoice> choice_;
    std::unique_ptr<const Drive> drive_;
    signals::SpanLayout span_;
    std::vector<SceneMesh> meshes_;
    std::vector<double> mean_pairs_;
    lockstep::PairSet pairs_;
    std::optional<const SceneFault> fault_;
    lockstep::MarchPlan plan_;
    std::unique_ptr<const lockstep::LoadShares> load_shares_;
    Stepping stepping_;
    std::optional<Calibration> calibration_;
    int te_samples_ = 0;
    int signal_meshes_ = 0;
    int most_recorded_ = std::numeric_limits<int>::max();
    int max_meshes_ = 1;
    double nominal_mesh_frequency_Hz_ = 0.0;
};

}  // namespace gearpod::mc
