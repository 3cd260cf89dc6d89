// The gears that a study describes.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dynamics/effects/mesh_law.hpp"
#include "gears/gear.hpp"
#include "gears/planetary.hpp"
#include "gears/working_pair.hpp"
#include "mc/study/study.hpp"
#include "stiffness/teeth/material.hpp"
#include "stiffness/teeth/tooth_profile.hpp"

namespace gearpod::mc {

std::string_view member_name(Member member);

// Two meshing members; the first drives and is external.
struct MeshMembers {
    MeshKind kind;
    Member driver, driven;
};

// The meshes of a kind of gearbox: sun-planet and planet-ring, or pinion-gear.
std::span<const MeshMembers> meshes_of(GearboxKind kind);

// "sun-planet", "ring-planet", "pinion-gear".
std::string mesh_name(const MeshMembers& mesh);

// Whether a gearbox of that kind has that member, and it has teeth.
bool has_toothed_member(GearboxKind kind, Member member);

// Its tooth number, if given.
std::optional<int> teeth_of(const Study& study, Member member);

// Centre distance of sun and planets, or of a pair. The study must have gears.
double centre_distance_m(const Study& study);

// Whether profile shifts or a centre distance are given, be they those of standard gears.
bool shift_given(const Study& study);
// The keys that give them, and the tip circles.
std::vector<std::string> shift_keys();
// All shifts of the study's gears, given or following. The study must have gears.
gears::WorkingShifts working_shifts(const Study& study);
// A planet's axis and tip circle, in modules; only of studies with shifts given.
gears::PlanetRoom planet_room(const Study& study);
// Relief and crowning of a member's flanks; true if any member has some.
gears::FlankRelief relief_of(const Study& study, Member member);
bool has_relief(const Study& study);
// True if tooth pairs have gaps that all gearboxes share: relief, crowning or extended contact.
bool has_flank_gaps(const Study& study);
// True if the meshes are computed tooth pair by tooth pair, each of which pushes and does not pull.
bool has_unilateral_teeth(const Study& study);
// Working pressure angle of a mesh in the plane in which the gears turn. The study must have gears.
double working_angle_rad(const Study& study, MeshKind mesh);

// Whether the study gives the meshes' stiffness instead of the teeth that make it.
bool stiffness_given(const Study& study);

// True if any mesh has a static transmission error given by its harmonics.
bool has_static_errors(const Study& study);

// The law of its meshes, and whether their teeth can lose contact under it.
dynamics::MeshLaw mesh_law(const Study& study);
bool teeth_can_part(const Study& study);
// Whether the teeth of any gearbox have errors of their own; a quality that says how large;
// measured ones.
bool has_tooth_errors(const Study& study);
bool has_tooth_quality(const Study& study);
bool has_measured_teeth(const Study& study);
// Whether the planets of any gearbox differ, and are drawn.
bool has_unlike_planets(const Study& study);
bool draws_planets(const Study& study);

// Whether all tooth numbers and the module are given.
bool has_gears(const Study& study);

// The pressure angle in the plane in which the gears turn.
double transverse_pressure_angle_rad(const Gearbox& gearbox);

// Modules: heights of teeth and shifts are counted in the normal one, a gears::Gear's in its own.
double normal_over_transverse(const Gearbox& gearbox);

// A toothed member of the study's gearbox, whose tooth number and module must be given. Helical
// gears stand for the spur gears that they are in the transverse plane.
gears::Gear gear_of(const Study& study, Member member);

// Where the beams of its teeth begin; of no meaning where the stiffness is given.
stiffness::Profile profile_of(const Study& study);

// What a mesh of rims and webs keeps of the stiffness of solid discs: the smaller of its two gears'
// factors (stiffness/foundation/gear_blank.hpp); 1 for discs and for a ring, whose rim its own
// elastic ring is.
double blank_factor(const Study& study, Member member);
double blank_factor(const Study& study, const MeshMembers& mesh);

// What the teeth of a mesh are made of, and how wide. They must not be without a face width.
// Young's modulus is that which gives the mesh what its gears' blanks leave: every part of a tooth
// pair's stiffness grows with it.
stiffness::Material material_of(const Study& study, const MeshMembers& mesh);

// Mesh periods by which helical teeth engage later at one end of the face width than at the other.
double overlap_ratio(const Study& study);

}  // namespace gearpod::mc
