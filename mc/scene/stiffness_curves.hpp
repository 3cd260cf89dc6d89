// Mesh stiffness while a faulty tooth engages, and which pairs it engages with.
#pragma once

#include <vector>

#include "mc/scene/scene.hpp"

namespace gearpod::mc {

// The first pair that the faulty tooth meets with each of its curves.
std::vector<int> faulty_pairs(const Scene& scene);

// The stiffness, N/m, of the pair `since` mesh periods after its faulty tooth engaged; before and
// after its engagement that of the healthy pair.
double faulty_total(const Scene& scene, int pair, const stiffness::FaultyMesh& mesh, double since);

// How far the gears of a pair approach along the line of action at a phase of the mesh period under
// the nominal load, m: the pair's loaded static transmission error.
double loaded_approach(const Scene& scene, int pair, double phase);

}  // namespace gearpod::mc
