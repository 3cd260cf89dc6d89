// Yang's gears (2022, Tables 1 and 2). He gives no bores: 10.5 mm gives a solid planet the mass of
// his (0.464 kg of steel on the pitch circle). The sun is heavier than a solid disc and carries a
// shaft; it is fixed at about the same fraction of its root circle, 10 mm.
#pragma once

#include "stiffness/coupled_mesh.hpp"
#include "stiffness/faults/spatial_crack.hpp"
#include "tests/stiffness/gear_pairs.hpp"

namespace yang_gears {

inline constexpr double kDegree = std::numbers::pi / 180;
inline constexpr gearpod::stiffness::Material kSteel{2.06e11, 0.3, 0.018};
inline constexpr double kSunBore = 10e-3, kPlanetBore = 10.5e-3, kRingOuter = 115e-3;

inline gearpod::gears::Gear gear(int teeth, bool internal = false) {
    return {teeth, internal, 2e-3, test_pairs::kPressureAngle};
}
inline gearpod::gears::MeshGeometry sun_planet() {
    return {gear(28), gear(34)};
}
inline gearpod::gears::MeshGeometry ring_planet() {
    return {gear(34), gear(96, true)};
}
// Mesh force for 40 N m on the sun and four planets.
inline double force() {
    return 40 / (4 * gear(28).base_radius());
}
inline gearpod::stiffness::CoupledMeshOptions options(
    gearpod::stiffness::FoundationModel foundation, gearpod::stiffness::Contact contact) {
    return {foundation, contact, kSunBore, kPlanetBore, force()};
}
inline gearpod::stiffness::CrackGrowth growth() {
    return {{0.5e-3, 1e-3, 1.5e-3, 2e-3, 2e-3},
            {0, 0, 0, 1e-3, 2e-3},
            {6e-3, 12e-3, 18e-3, 18e-3, 18e-3},
            std::vector<double>(5, 0.5e-3),
            std::vector<double>(5, 2e-3),
            45 * kDegree,
            90 * kDegree};
}

}  // namespace yang_gears
