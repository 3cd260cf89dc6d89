// Mesh stiffness while a faulty tooth engages, and the gear pairs in which it engages.
#pragma once

#include <vector>

#include "mc/scene/scene.hpp"

namespace gearpod::mc {

// First gear pair in which the faulty tooth engages, for each of its stiffness curves.
std::vector<int> faulty_pairs(const Scene& scene);

// Stiffness, N/m, of the gear pair `since` mesh periods after its faulty tooth started to engage;
// outside its engagement, that of the healthy pair.
double faulty_total(const Scene& scene, int pair, const stiffness::FaultyMesh& mesh, double since);

// Loaded static transmission error of a gear pair, m: approach of its gears along the line of
// action at a phase of the mesh period under the nominal load.
double loaded_approach(const Scene& scene, int pair, double phase);

}  // namespace gearpod::mc
