// The gear pairs of the sources and a few that cover the other branches of the geometry.
#pragma once

#include "gears/mesh_geometry.hpp"
#include "stiffness/teeth/material.hpp"
#include "stiffness/teeth/tooth_profile.hpp"
#include "tests/test.hpp"

namespace test_pairs {

inline constexpr double kPressureAngle = 20 * std::numbers::pi / 180;
inline constexpr double kModule = 3.175e-3;
inline constexpr double kCrackAngle = 45 * std::numbers::pi / 180;

inline gearpod::gears::Gear external(int teeth) {
    return {teeth, false, kModule, kPressureAngle};
}
inline gearpod::gears::Gear internal(int teeth) {
    return {teeth, true, kModule, kPressureAngle};
}

inline constexpr gearpod::stiffness::Material kLiangSteel{2.068e11, 0.3, 0.0381};
inline constexpr gearpod::stiffness::Material kTianSteel{2.068e11, 0.3, 0.016};

struct CrackedGear {
    std::string name;
    gearpod::gears::MeshGeometry geometry;
    gearpod::stiffness::Profile profile;
    int which;
};

inline std::vector<CrackedGear> cracked_gears() {
    using gearpod::stiffness::Profile;
    const gearpod::gears::MeshGeometry sun_planet(external(19), external(31));
    const gearpod::gears::MeshGeometry ring_planet(external(31), internal(81));
    const gearpod::gears::MeshGeometry tian(external(19), external(48));
    return {{"sun", sun_planet, Profile::root_circle, 1},
            {"planet, sun side", sun_planet, Profile::root_circle, 2},
            {"planet, ring side", ring_planet, Profile::root_circle, 1},
            {"ring", ring_planet, Profile::root_circle, 2},
            {"Tian's pinion", tian, Profile::base_circle, 1},
            {"48 teeth, root outside base", tian, Profile::root_circle, 2},
            {"41 teeth, root at base", {external(41), external(42)}, Profile::root_circle, 1},
            {"120 teeth", {external(60), external(120)}, Profile::root_circle, 2}};
}

}  // namespace test_pairs
