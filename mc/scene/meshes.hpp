// The stiffness of a study's healthy gear pairs.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "gears/mesh_geometry.hpp"
#include "lockstep/plan/stiffness_nodes.hpp"
#include "mc/scene/drive.hpp"
#include "mc/study/gears.hpp"
#include "stiffness/foundation/fillet_foundation.hpp"
#include "stiffness/loaded_mesh.hpp"
#include "stiffness/mesh_stiffness.hpp"

namespace gearpod::mc {

// One kind of gear pair. Without tooth shapes (given stiffness) it has no geometry.
struct SceneMesh {
    MeshMembers members;
    std::optional<gears::MeshGeometry> geometry;
    std::unique_ptr<const stiffness::MeshStiffness> stiffness;
    // Under what a pair carries on average, with the gears' relief.
    std::unique_ptr<const stiffness::LoadedMesh> loaded;
    // Of either gear, if the mesh has one.
    const stiffness::FilletFoundation* body[2] = {nullptr, nullptr};
};

// The circle on which a gear's body is held: half of the diameter given, 0 if none is.
double body_radius_m(const Study& study, Member member);

// One for each of meshes_of(kind); `force_N` is what a pair carries on average, for contacts that
// stiffen with it and for relief. Throws SceneError.
std::vector<SceneMesh> make_meshes(const Study& study, double force_N);

// All pairs of the gearbox and their phases.
lockstep::PairSet make_pairs(const std::vector<SceneMesh>& meshes, const Drive& drive);

// Mean stiffness of all pairs of a gearbox of constant stiffness, N/m; also without teeth.
std::vector<double> constant_pairs(const Study& study);

}  // namespace gearpod::mc
