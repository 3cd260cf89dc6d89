// Gears that a study describes.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dynamics/effects/mesh_law.hpp"
#include "gears/flank_gaps.hpp"
#include "gears/gear.hpp"
#include "gears/mesh_geometry.hpp"
#include "gears/planetary.hpp"
#include "mc/study/study.hpp"
#include "stiffness/teeth/material.hpp"
#include "stiffness/teeth/tooth_profile.hpp"

namespace gearpod::mc {

std::string_view member_name(Member member);
// Key in the member's table: "gearbox.sun.teeth".
std::string member_key(Member member, std::string_view label);
// Name of the table of the meshes of a kind in [gearbox].
std::string_view mesh_table(MeshKind mesh);

// Two meshing members; the first one drives and is external.
struct MeshMembers {
    MeshKind kind;
    Member member_1, member_2;
};

// Meshes of a kind of gearbox: sun-planet and planet-ring, or pinion-gear.
std::span<const MeshMembers> meshes_of(GearboxKind kind);

// True if such a gearbox has that shaft, and which ones it has: "use "pinion" or "gear"".
bool has_shaft(GearboxKind kind, Member shaft);
std::string use_shafts_text(GearboxKind kind);

// "sun-planet", "ring-planet", "pinion-gear".
std::string mesh_name(const MeshMembers& mesh);

// True if a gearbox of that kind has that member and the member has teeth.
bool has_toothed_member(GearboxKind kind, Member member);

// Number of teeth of a member; empty if not given.
std::optional<int> teeth_of(const Study& study, Member member);

// Centre distance of sun and planets, or of a gear pair, m; for a study with gears.
double centre_distance_m(const Study& study);

// True if a profile shift or a centre distance is given, even that of standard gears.
bool shift_given(const Study& study);
// Keys of profile shifts, centre distance and tip diameters.
std::vector<std::string> shift_keys();
// All profile shifts of the study's gears, given or derived.
gears::WorkingShifts working_shifts(const Study& study);
// Radius of the planets' axes and diameter of their tip circle, in modules, of a study with shifts.
gears::PlanetDimensions planet_dimensions(const Study& study);
// Relief and crowning of a member's flanks; has_relief(): true if any member has some.
gears::FlankRelief relief_of(const Study& study, Member member);
bool has_relief(const Study& study);
// True if tooth pairs have gaps that are the same in all gearboxes: relief, crowning or extended
// contact.
bool has_flank_gaps(const Study& study);
// True if the mesh force is computed tooth pair by tooth pair with unilateral contact, which
// transmits compression only.
bool has_unilateral_teeth(const Study& study);
// Working pressure angle of a mesh in the transverse plane.
double working_angle_rad(const Study& study, MeshKind mesh);

// True if the study gives the mesh stiffness, so that it is not computed from the teeth.
bool stiffness_given(const Study& study);

// True if any mesh has a static transmission error given by its harmonics.
bool has_static_errors(const Study& study);

// Contact law of the study's meshes. teeth_can_separate(): true if teeth can lose contact under it.
dynamics::MeshLaw mesh_law(const Study& study);
bool teeth_can_separate(const Study& study);
// has_tooth_errors(): true if the teeth of any gearbox deviate individually. has_tooth_quality():
// true if an ISO 1328 grade gives their size. has_measured_teeth(): true if measured deviations are
// given.
bool has_tooth_errors(const Study& study);
bool has_tooth_quality(const Study& study);
bool has_measured_teeth(const Study& study);
// has_unequal_planets(): true if the planets of any gearbox differ. has_random_planets(): true if
// their differences are random.
bool has_unequal_planets(const Study& study);
bool has_random_planets(const Study& study);

// True if all tooth numbers and the module are given.
bool has_gears(const Study& study);

// Pressure angle in the transverse plane.
double transverse_pressure_angle_rad(const Gearbox& gearbox);

// Ratio of normal to transverse module. Studies give tooth heights and shifts in normal modules, a
// gears::Gear in its own (transverse) module.
double normal_over_transverse(const Gearbox& gearbox);

// Gear of a toothed member. Helical gears are replaced by the equivalent spur gears in the
// transverse plane.
gears::Gear gear_of(const Study& study, Member member);

// Profile that defines the root of the beam model of its teeth; meaningless where the stiffness is
// given.
stiffness::Profile profile_of(const Study& study);

// Gear blank factor: stiffness of a mesh with rims and webs relative to that of solid discs
// (stiffness/iso_6336.hpp). For a mesh, the smaller of its two gears' factors. 1 for
// discs, and for a ring, whose rim is modelled as an elastic ring.
double blank_factor(const Study& study, Member member);
double blank_factor(const Study& study, const MeshMembers& mesh);

// Material and face width of the teeth of a mesh. Young's modulus is multiplied by the mesh's blank
// factor, because every part of a tooth pair's stiffness is proportional to it.
stiffness::Material material_of(const Study& study, const MeshMembers& mesh);

// Overlap ratio: number of mesh periods by which helical teeth engage later at one end of the face
// width than at the other.
double overlap_ratio(const Study& study);

// Meshes in which a fault acts.

// Mesh of meshes_of(kind) in which the faulty tooth acts, and its gear in that mesh, 1 or 2.
struct FaultPlace {
    std::size_t mesh;
    int gear;
};
std::vector<FaultPlace> fault_places(const Fault& fault);

}  // namespace gearpod::mc
