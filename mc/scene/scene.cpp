#include "mc/scene/scene.hpp"

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "mc/gearbox/instance_features.hpp"
#include "mc/numerics/choice.hpp"
#include "mc/scene/body.hpp"
#include "mc/scene/driving.hpp"
#include "mc/study/gears.hpp"
#include "mc/study/schema/sizes.hpp"

namespace gearpod::mc {
namespace {

using std::numbers::pi;

const Study& with_gears(const Study& study) {
    if (!has_gears(study)) {
        throw std::invalid_argument("a scene needs tooth numbers and a module");
    }
    return study;
}

}  // namespace

Scene::Scene(const Study& study)
    : study_(with_gears(study)), drive_(make_drive(study_)), span_(drive_->span()) {
    if (auto choice = choose_numerics(study_)) {
        study_.numerics = choice->numerics;
        choice_ = std::make_unique<const NumericsChoice>(*std::move(choice));
    }
    const InstanceInputs nominal = Sampler(study_).nominal();
    nominal_mesh_frequency_Hz_ = drive_->mesh_frequency_rad_s(nominal.speed_rad_s) / (2.0 * pi);
    build_stiffness();
    build_plan();
    signal_meshes_ = meshes_needed(*this, needs_of(used_features(study_)));
}

Scene::~Scene() = default;

void Scene::use(const Numerics& numerics) {
    const Numerics before = study_.numerics;
    Numerics settled_alike = before;
    settled_alike.settle_tolerance = numerics.settle_tolerance;
    study_.numerics = numerics;
    if (settled_alike == numerics) {
        settle();
        return;
    }
    const bool same_stiffness = before.stiffness_tolerance == numerics.stiffness_tolerance;
    try {
        if (!same_stiffness) {
            build_stiffness();
        }
        build_plan();
    } catch (...) {
        study_.numerics = before;
        if (!same_stiffness) {
            build_stiffness();
        }
        throw;
    }
}

void Scene::build_stiffness() {
    meshes_ = make_meshes(study_, drive_->mesh_force_N(Sampler(study_).nominal()));
    mean_pairs_.clear();
    for (const SceneMesh& mesh : meshes_) {
        mean_pairs_.insert(mean_pairs_.end(), static_cast<std::size_t>(drive_->pairs_per_mesh()),
                           mean_total(*mesh.stiffness));
    }
    pairs_ = make_pairs(meshes_, *drive_);
    fault_.emplace(study_, meshes_, pairs_);
}

void Scene::settle() {
    if (!study_.effects.quasi_static()) {
        max_meshes_ = choose_max_meshes(study_, stepping_.decay_meshes);
    }
}

std::vector<double> Scene::stiffest_pairs() const {
    constexpr int kPhases = 200;
    std::vector<double> k;
    for (int i = 0; i < pairs_.pairs(); ++i) {
        double stiffest = 0.0;
        for (int p = 0; p < kPhases; ++p) {
            stiffest = std::max(stiffest, pairs_.total(i, static_cast<double>(p) / kPhases));
        }
        k.push_back(stiffest);
    }
    return k;
}

// Steps end on the jumps of the fault's own law, too.
std::vector<double> Scene::transitions() const {
    std::vector<double> all = lockstep::contact_transitions(pairs_);
    const std::vector<double> jumps = fault_->jumps(pairs_);
    if (!jumps.empty()) {
        all.insert(all.end(), jumps.begin(), jumps.end());
        std::sort(all.begin(), all.end());
        all.erase(std::unique(all.begin(), all.end()), all.end());
    }
    return all;
}

void Scene::build_plan() {
    plan_.layout = gearbox_layout(study_);
    const Sampling sampling = choose_sampling(study_, nominal_mesh_frequency_Hz_);
    te_samples_ = sampling.te_samples;
    // Without inertia the samples are all there is to compute.
    stepping_.steps = sampling.samples;
    if (!study_.effects.quasi_static()) {
        stepping_ = choose_stepping(study_, *drive_, plan_.layout, stiffest_pairs());
        plan_.low_pass_rad_s = 2.0 * pi * study_.sensor.low_pass_Hz;
    }
    settle();
    plan_.integrator = stepping_.integrator;
    plan_.precision = study_.numerics.precision;
    plan_.te_weight = drive_->te_weight(plan_.layout);
    if (study_.effects.separation != Separation::none) {
        plan_.mesh_law = dynamics::MeshLaw::separating;
    } else if (has_pitch_errors(study_) || !first_errors().amplitude_m.empty() ||
               !second_errors().amplitude_m.empty()) {
        plan_.mesh_law = dynamics::MeshLaw::with_error;
    }
    SceneGrid chosen =
        choose_grid(study_, stepping_, sampling.samples, transitions(), [this] { return pilot(); });
    calibration_ = chosen.calibration;
    plan_ = plan_of(std::move(chosen.grid));
    check_driving(study_, *drive_, plan_);
    if (has_pitch_errors(study_)) {
        load_shares_ = std::make_unique<const lockstep::LoadShares>(pairs_, plan_.grid);
    }
}

lockstep::MarchPlan Scene::plan_of(lockstep::PhaseGrid grid) const {
    lockstep::MarchPlan plan = plan_;
    plan.grid = std::move(grid);
    plan.nodes = lockstep::tabulate(pairs_, plan.grid, study_.effects.mesh_damping);
    if (plan.mesh_law != dynamics::MeshLaw::linear) {
        std::vector<lockstep::MeshError> errors(static_cast<std::size_t>(drive_->pairs_per_mesh()),
                                                first_errors());
        errors.resize(static_cast<std::size_t>(pairs_.pairs()), second_errors());
        lockstep::add_errors(pairs_, plan.grid, errors, plan.nodes);
    }
    return plan;
}

// Errors of one kind of mesh are alike for all planets, shifted with their mesh phases.
lockstep::MeshError Scene::first_errors() const {
    const MeshErrors& e = study_.errors;
    return study_.gearbox.kind == GearboxKind::fixed_shaft
               ? lockstep::MeshError{e.mesh_m, e.mesh_phase_rad}
               : lockstep::MeshError{e.sun_planet_m, e.sun_planet_phase_rad};
}

lockstep::MeshError Scene::second_errors() const {
    return {study_.errors.ring_planet_m, study_.errors.ring_planet_phase_rad};
}

// The nominal gearbox and the first graded ones, all with the largest fault. The same for every run
// of the study.
lockstep::Pilot Scene::pilot() const {
    const Sampler sampler(study_);
    const std::vector<double> sizes = fault_sizes(study_);
    lockstep::Pilot pilot;
    pilot.faults = {&pairs_, pattern(), {}};
    pilot.faults.curve.resize(static_cast<std::size_t>(fault_->curves()));
    for (int lane = 0; lane < lockstep::kPilotLanes; ++lane) {
        pilot.inputs.push_back(inputs(
            lane == 0 ? sampler.nominal()
                      : sampler.sample(Group::graded, static_cast<std::uint64_t>(lane - 1))));
        for (int curve = 0; curve < fault_->curves(); ++curve) {
            pilot.faults.curve[static_cast<std::size_t>(curve)].push_back(
                fault_->mesh(curve, sizes.empty() ? 0.0 : sizes.back()));
        }
    }
    // The orbit to a thousandth; what is left of the approach is alike on all grids.
    constexpr double kDecays = 7.0, kMostMeshes = 100.0;
    const double decays = std::ceil(1.0 + kDecays * stepping_.decay_meshes);
    pilot.settle_meshes = static_cast<int>(std::min(kMostMeshes, decays));
    pilot.plan = [this](lockstep::PhaseGrid grid) { return plan_of(std::move(grid)); };
    return pilot;
}

}  // namespace gearpod::mc
