// Planetary gearbox with 9 + 3N degrees of freedom, as mass, damping and stiffness matrices.
//
// Order of the motions q: carrier, ring, sun, planets 1..N. Each has x, y (m, in the frame that
// rotates with the carrier) and u = r theta (m; r is the base radius, or the centre distance for
// the carrier). Every spring-damper is one row v of the deflection d = v . q; it adds k v v^T and c
// v v^T. Lin and Parker (1999); Liang (2016), Eqs. 4.2.1-4.2.4 in this energy-consistent form.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dynamics/effects/mesh_damping.hpp"
#include "dynamics/effects/mesh_law.hpp"
#include "dynamics/eigen_forward.hpp"
#include "gears/planetary.hpp"
#include "machine/ids.hpp"
#include "machine/instruction_sets.hpp"

namespace gearpod::dynamics {

struct GearboxMatrices;
struct SpringDamper;

inline constexpr int kMaxPlanets = 8;
inline constexpr int kMaxPairs = 2 * kMaxPlanets;
inline constexpr int kBearingSources = 2;  // sun and carrier, after the planets
inline constexpr int kMaxSources = kMaxPlanets + kBearingSources;

enum class Motion { translational_torsional, torsional };

// Order of the bodies in arrays and among the motions.
inline constexpr int carrier = 0, ring = 1, sun = 2, planet = 3, body_count = 4;

// Index of a body's x motion; y and u follow. n = 0..N-1 for planets.
GEARPOD_INLINE int motion_index(int body, int n = 0) {
    return 3 * (body + n);
}

// Index of the x motion of a source: of planets 1..N, then of sun and carrier.
GEARPOD_INLINE int source_motion_index(int planets, int source) {
    return source < planets    ? motion_index(planet, source)
           : source == planets ? motion_index(sun)
                               : motion_index(carrier);
}

// Properties common to all gearboxes of an ensemble.
struct PlanetaryLayout {
    int planets = 0;
    double pressure_angle_rad = 0.0;    // of the normal plane for helical teeth
    double helix_angle_rad = 0.0;       // see helical_pair.hpp for its effect on the stiffness
    std::vector<double> positions_rad;  // psi_n; empty: equally spaced
    double carrier_radius_m = 0.0;      // centre distance; used only by inertial terms
    gears::Member fixed = gears::Member::ring;
    Motion motion = Motion::translational_torsional;
    bool inertial_terms = true;
    MeshDamping mesh_damping = MeshDamping::ratio;
    // Working pressure angles in the plane of rotation, if profile shift changes them.
    std::optional<double> sun_working_angle_rad = {}, ring_working_angle_rad = {};
    // Sun and carrier are sources, too; only in translational motion.
    bool bearing_sources = false;

    int pairs() const { return 2 * planets; }
    // Locations whose acceleration the sensor measures.
    int sources() const { return planets + (bearing_sources ? kBearingSources : 0); }
    int motions() const { return 9 + 3 * planets; }
    int degrees_of_freedom() const { return motion == Motion::torsional ? 3 + planets : motions(); }
    // Index of the rotation u of carrier, ring, sun or (planet + n) among the degrees of freedom.
    int rotation_index(int body) const { return motion == Motion::torsional ? body : 3 * body + 2; }
    double planet_angle(int n) const;  // psi_n, rad
    double transverse_pressure_angle() const;
    // Angle between a mesh's line of action and the normal to its centre line.
    double sun_mesh_angle() const {
        return sun_working_angle_rad.value_or(transverse_pressure_angle());
    }
    double ring_mesh_angle() const {
        return ring_working_angle_rad.value_or(transverse_pressure_angle());
    }
};

// Offset of a planet's pin from the nominal position in the carrier, m along the frame's x and y.
// The bearing is unloaded at that offset.
struct PlanetDeviations {
    double pin_x_m = 0.0, pin_y_m = 0.0;
};

// Parameters that differ between gearboxes; SI units. Arrays are in the order of the bodies.
struct PlanetaryInputs {
    double mass_kg[body_count] = {};
    double inertia_over_r2_kg[body_count] = {};  // J / r^2, r as for u
    double bearing_stiffness_N_m[body_count] = {};
    double bearing_damping_N_s_m[body_count] = {};
    double support_stiffness_N_m = 0.0;  // of the fixed member's u
    double support_damping_N_s_m = 0.0;
    double mesh_damping = 0.0;  // parameter of the layout's law
    double carrier_speed_rad_s = 0.0;
    double mesh_period_s = 0.0;
    double backlash_m = kNoBackContact;  // 2b along the line of action; for separating meshes
    double force_N[3] = {};              // on u of carrier, ring, sun: torque / r
    PlanetDeviations planet_deviations[kMaxPlanets] = {};  // of planets 1..N
};

// Row vectors of the deflections over all 9 + 3N motions. Pairs are sp1..spN, rp1..rpN.
Eigen::VectorXd pair_row(const PlanetaryLayout& layout, PairId pair);
Eigen::VectorXd planet_bearing_row(const PlanetaryLayout& layout, int n, int axis);

// All spring-dampers over the 9 + 3N motions, for the given stiffness of the 2N pairs (sp1..spN,
// rp1..rpN).
std::vector<SpringDamper> spring_dampers(const PlanetaryLayout& layout,
                                         const PlanetaryInputs& inputs,
                                         const std::vector<double>& pair_stiffness_N_m);

// Matrix from the layout's degrees of freedom to all motions. In torsional motion, planets cannot
// move on their bearings: x_n = -u_c sin psi_n, y_n = u_c cos psi_n.
Eigen::MatrixXd motions_from_degrees(const PlanetaryLayout& layout);

// Matrices over the layout's degrees of freedom. `torsional` motion ties each planet to the carrier
// (rigid planet bearings) and keeps the rotations: carrier, ring, sun, planets.
GearboxMatrices assemble(const PlanetaryLayout& layout, const PlanetaryInputs& inputs,
                         const std::vector<double>& pair_stiffness_N_m);

// Names of the degrees of freedom: carrier_x, carrier_y, carrier_u, ...
std::vector<std::string> motion_names(const PlanetaryLayout& layout);

// Position of a central member in that order.
int body_index(gears::Member member);

// Mesh damping of a pair by the layout's law.
double mesh_damping_factor(const PlanetaryLayout& layout, const PlanetaryInputs& inputs,
                           PairId pair);

// Motion without any deflection: free rotation of the train relative to its fixed member. It is
// neutral in a real gearbox. In the linear model, the centrifugal term W^2 x lets it grow at a rate
// near W. The model lacks the rotation of the bearing force that cancels this term. The time
// integration therefore removes it (lockstep/tile).
Eigen::VectorXd rigid_rotation(const PlanetaryLayout& layout);

}  // namespace gearpod::dynamics
