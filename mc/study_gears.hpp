// The gears that a study describes.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "gears/gear.hpp"
#include "mc/study.hpp"

namespace gearpod::mc {

std::string_view member_name(Member member);

// Two meshing members; the first drives and is external.
struct MeshMembers {
    Member driver, driven;
};

// The meshes of a kind of gearbox: sun-planet and planet-ring, or pinion-gear.
std::span<const MeshMembers> meshes_of(GearboxKind kind);

// Whether a gearbox of that kind has that member, and it has teeth.
bool has_toothed_member(GearboxKind kind, Member member);

// Its tooth number, if given.
std::optional<int> teeth_of(const Study& study, Member member);

// Whether all tooth numbers and the module are given.
bool has_gears(const Study& study);

// A toothed member of the study's gearbox, whose tooth number and module must be given.
gears::Gear gear_of(const Study& study, Member member);

// Length of the longest crack that the faulty member's tooth holds, m: there it breaks. The study
// must have the tooth geometry and a crack.
double max_crack_depth_m(const Study& study);

// Radii of the faulty member's flank that touches its mate, lowest and highest, m. A planet's flank
// on the faulty side.
struct ActiveFlank {
    double low_m, high_m;
};
ActiveFlank active_flank(const Study& study);

}  // namespace gearpod::mc
