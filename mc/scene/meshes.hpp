// Mesh stiffness of a study's healthy gear pairs.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "gears/mesh_geometry.hpp"
#include "lockstep/plan/stiffness_nodes.hpp"
#include "mc/scene/drivetrain.hpp"
#include "mc/study/gears.hpp"
#include "stiffness/foundation/fillet_foundation.hpp"
#include "stiffness/loaded_mesh.hpp"
#include "stiffness/mesh_stiffness.hpp"

namespace gearpod::mc {

// One kind of gear pair. It has no geometry if the stiffness is given instead of tooth shapes.
struct SceneMesh {
    MeshMembers members;
    std::optional<gears::MeshGeometry> geometry;
    std::unique_ptr<const stiffness::MeshStiffness> stiffness;
    // Quasi-static contact under the mean force of a pair, including the flanks' gaps.
    std::unique_ptr<const stiffness::LoadedMesh> loaded;
    // Elastic bodies of the two gears, if modelled.
    const stiffness::FilletFoundation* body[2] = {nullptr, nullptr};
};

// Radius of the circle on which a gear's body is held, m; 0 if the study gives none.
double body_radius_m(const Study& study, Member member);

// Upper estimate of the single pitch errors of a member's teeth, m: the tolerance of their grade
// plus three times a given rms, and at least the largest measured deviation.
double pitch_error_m(const Study& study, Member member);

// Mean stiffness of a mesh, N/m, in the transverse plane. Precondition: stiffness_given().
double given_mean_stiffness(const Study& study, MeshKind mesh);

// Makes one mesh for each of meshes_of(kind). force_N: mean force of a pair, for load-dependent
// contact and for the flanks' gaps. Throws SceneError.
std::vector<SceneMesh> make_meshes(const Study& study, double force_N);

// All gear pairs of the gearbox and their phases.
lockstep::PairSet make_pairs(const std::vector<SceneMesh>& meshes, const Drivetrain& drivetrain);

// Mean stiffness of all pairs of a gearbox with constant stiffness, N/m; also without teeth.
std::vector<double> constant_pairs(const Study& study);

}  // namespace gearpod::mc
