#include "mc/scene.hpp"

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "mc/instance_features.hpp"
#include "mc/numerics_choice.hpp"
#include "mc/scene_body.hpp"
#include "mc/study_gears.hpp"

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
    meshes_ = make_meshes(study_, drive_->mesh_force_N(nominal));
    pairs_ = make_pairs(meshes_, *drive_);
    fault_.emplace(study_, meshes_, pairs_);
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
    try {
        build_plan();
    } catch (...) {
        study_.numerics = before;
        throw;
    }
}

void Scene::settle() {
    if (!study_.effects.quasi_static()) {
        max_meshes_ = choose_max_meshes(study_, stepping_.decay_meshes);
    }
}

std::vector<double> Scene::mean_pairs() const {
    std::vector<double> k;
    for (const SceneMesh& mesh : meshes_) {
        k.insert(k.end(), static_cast<std::size_t>(drive_->pairs_per_mesh()),
                 mean_total(*mesh.stiffness));
    }
    return k;
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
    plan_.grid = lockstep::make_phase_grid(sampling.samples, stepping_.steps, transitions());
    plan_.grid.stage_nodes = lockstep::stage_nodes(plan_.integrator);
    plan_.nodes = lockstep::tabulate(pairs_, plan_.grid, study_.effects.mesh_damping);
    plan_.te_weight = drive_->te_weight(plan_.layout);
    add_errors();
}

// Errors of one kind of mesh are alike for all planets, shifted with their mesh phases.
void Scene::add_errors() {
    const MeshErrors& e = study_.errors;
    const bool pitch =
        e.pitch_error_m > 0.0 || study_.find_random("gearbox.pitch_error_um") != nullptr;
    const lockstep::MeshError first =
        study_.gearbox.kind == GearboxKind::fixed_shaft
            ? lockstep::MeshError{e.mesh_m, e.mesh_phase_rad}
            : lockstep::MeshError{e.sun_planet_m, e.sun_planet_phase_rad};
    const lockstep::MeshError second{e.ring_planet_m, e.ring_planet_phase_rad};
    const bool any = pitch || !first.amplitude_m.empty() || !second.amplitude_m.empty();
    if (study_.effects.separation != Separation::none) {
        plan_.mesh_law = dynamics::MeshLaw::separating;
    } else if (any) {
        plan_.mesh_law = dynamics::MeshLaw::with_error;
    }
    if (plan_.mesh_law == dynamics::MeshLaw::linear) {
        return;
    }
    std::vector<lockstep::MeshError> errors(static_cast<std::size_t>(drive_->pairs_per_mesh()),
                                            first);
    errors.resize(static_cast<std::size_t>(pairs_.pairs()), second);
    lockstep::add_errors(pairs_, plan_.grid, errors, plan_.nodes);
    if (pitch) {
        load_shares_ = std::make_unique<const lockstep::LoadShares>(pairs_, plan_.grid);
    }
}

}  // namespace gearpod::mc
