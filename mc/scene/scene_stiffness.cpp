#include "mc/scene/scene_stiffness.hpp"

#include <algorithm>

#include "stiffness/loaded_mesh.hpp"

namespace gearpod::mc {
namespace {

gears::DeviationScales grade_5(const Gearbox& gearbox, const gears::Gear& gear) {
    const double normal_module_m = gear.module_m * normal_over_transverse(gearbox);
    return gears::scales_of(
        gears::tooth_tolerances(normal_module_m, 2.0 * gear.pitch_radius(), 5.0), gear.teeth,
        gear.pressure_angle_rad);
}

// Stiffness with all tooth pairs in contact that can touch at a position.
double sum_of_springs(const stiffness::MeshStiffness& mesh, double tau) {
    std::vector<stiffness::ContactSpring> springs;
    add_springs(mesh, tau, tau, springs);
    return secant_stiffness(springs, 0.0);
}

}  // namespace

SceneStiffness::SceneStiffness(const Study& study, const Drivetrain& drivetrain)
    : meshes_(make_meshes(study, drivetrain.mesh_force_N(nominal_inputs(study)))),
      pairs_(make_pairs(meshes_, drivetrain)),
      fault_(study, meshes_, pairs_) {
    for (const SceneMesh& mesh : meshes_) {
        mean_pairs_.insert(mean_pairs_.end(), static_cast<std::size_t>(drivetrain.pairs_per_mesh()),
                           mean_total(*mesh.stiffness));
        for (const Member member : {mesh.members.member_1, mesh.members.member_2}) {
            if (has_tooth_quality(study) && tooth_scales_[member].pitch == 0.0) {
                tooth_scales_[member] = grade_5(study.gearbox, gear_of(study, member));
            }
        }
    }
}

std::vector<double> SceneStiffness::stiffest_pairs() const {
    constexpr int kPhases = 200;
    std::vector<double> k;
    for (int i = 0; i < pairs_.pairs(); ++i) {
        double stiffest = 0.0;
        for (int p = 0; p < kPhases; ++p) {
            const double phase = static_cast<double>(p) / kPhases;
            stiffest = std::max(stiffest, pairs_.curve(i).has_gaps()
                                              ? sum_of_springs(pairs_.curve(i), phase)
                                              : pairs_.total(i, phase));
        }
        k.push_back(stiffest);
    }
    return k;
}

// Steps also end on the jumps of the fault's stiffness.
std::vector<double> SceneStiffness::transitions() const {
    std::vector<double> all = lockstep::contact_transitions(pairs_);
    const std::vector<double> jumps = fault_.jumps(pairs_);
    if (!jumps.empty()) {
        all.insert(all.end(), jumps.begin(), jumps.end());
        std::sort(all.begin(), all.end());
        all.erase(std::unique(all.begin(), all.end()), all.end());
    }
    return all;
}

}  // namespace gearpod::mc
