// Pairs with mesh stiffness from other programs, and the program's models of them:
// docs/validation/mesh-stiffness-level.md.
#pragma once

#include "gears/mesh_geometry.hpp"
#include "stiffness/contact/load_sharing.hpp"
#include "stiffness/foundation/fillet_foundation.hpp"
#include "stiffness/mesh_stiffness.hpp"
#include "stiffness/teeth/material.hpp"
#include "stiffness/teeth/tooth_profile.hpp"
#include "tests/test.hpp"

namespace mesh_level {

struct LevelPair {
    std::string name;  // tooth numbers
    gearpod::gears::MeshGeometry geometry;
    gearpod::stiffness::Material material;
    double helix_rad = 0;
    double held_1_m = 0, held_2_m = 0;  // radii of the circles on which the bodies are fixed
    double force_N = 0;                 // along the line of action
    gearpod::stiffness::Profile profile = gearpod::stiffness::Profile::fillet;
    std::string elements = {};  // case of tests/peers/fem-gear-pairs; "" without finite elements
    double report_N_m = 0;      // c_gamma_alpha printed by KISSsoft, times the face width
    double report_blank = 1.0;  // with this gear blank factor, C_R
};

// All pairs: steel discs with bores of a third of the root circles; the NREL 5 MW stages; the pairs
// of tests/peers/fem-gear-pairs without a crack.
std::vector<LevelPair> all_pairs();

// The healthy pair of a case of tests/peers/fem-gear-pairs.
const LevelPair& pair_of_case(const std::string& name);

std::unique_ptr<const gearpod::stiffness::MeshStiffness> model(
    const LevelPair& pair, gearpod::stiffness::FoundationModel foundation,
    gearpod::stiffness::Contact contact);

// Mean over a mesh period, N/m.
double model_mean(const LevelPair& pair, gearpod::stiffness::FoundationModel foundation,
                  gearpod::stiffness::Contact contact);
// Mean for elastic rings with linear contacts, without the twist of the bodies between the fixed
// circle and the root.
double untwisted_ring_mean(const LevelPair& pair);
// Mean for finite elements, whole gears in plane strain; 0 without them.
double elements_mean(const LevelPair& pair);
double untwisted_elements_mean(const LevelPair& pair);

// Compliance along the line of action due to the twist of both gear bodies between the fixed circle
// and the root circle, m/N.
double twist_compliance(const LevelPair& pair);

}  // namespace mesh_level
