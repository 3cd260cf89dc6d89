// Planetary gearbox with 9 + 3N degrees of freedom, as mass, damping and stiffness matrices.
//
// Order of the motions q: carrier, ring, sun, planets 1..N; each x, y (m, in the frame that turns
// with the carrier) and u = r theta (m; r the base radius, for the carrier the centre distance).
// Every spring-damper is one row v of the deflection d = v . q; it adds k v v^T and c v v^T.
// Lin and Parker (1999); Liang (2016), Eqs. 4.2.1-4.2.4 in this energy-consistent form.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "gears/planetary.hpp"

namespace gearpod::dynamics {

inline constexpr int kMaxPlanets = 8;
inline constexpr int kMaxPairs = 2 * kMaxPlanets;

enum class Motion { translational_torsional, torsional };
enum class MeshDamping { ratio, proportional, constant };

enum Body { carrier, ring, sun, planet, body_count };

// Index of a body's x motion; y and u follow. n = 0..N-1 for planets.
inline int motion_index(Body body, int n = 0) {
    return 3 * (body + n);
}

// What all gearboxes of an ensemble share.
struct PlanetaryLayout {
    int planets = 0;
    double pressure_angle_rad = 0.0;    // of the normal plane, if the teeth are helical
    double helix_angle_rad = 0.0;       // see helical_pair.hpp for what it does to a stiffness
    std::vector<double> positions_rad;  // psi_n; empty: equally spaced
    double carrier_radius_m = 0.0;      // centre distance; only inertial terms need it
    gears::FixedMember fixed = gears::FixedMember::ring;
    Motion motion = Motion::translational_torsional;
    bool inertial_terms = true;
    MeshDamping mesh_damping = MeshDamping::ratio;

    int pairs() const { return 2 * planets; }
    int motions() const { return 9 + 3 * planets; }
    int degrees_of_freedom() const { return motion == Motion::torsional ? 3 + planets : motions(); }
    double planet_angle(int n) const;  // psi_n, rad
    double transverse_pressure_angle() const;
};

// What differs between gearboxes; SI units. Arrays are indexed by Body.
struct PlanetaryInputs {
    double mass_kg[body_count] = {};
    double inertia_over_r2_kg[body_count] = {};  // J / r^2, r as for u
    double bearing_stiffness_N_m[body_count] = {};
    double bearing_damping_N_s_m[body_count] = {};
    double support_stiffness_N_m = 0.0;  // holds the fixed member's u
    double support_damping_N_s_m = 0.0;
    double mesh_damping = 0.0;  // ratio (1), time (s) or constant (N s/m), as the layout says
    double carrier_speed_rad_s = 0.0;
    double mesh_period_s = 0.0;
    double force_N[3] = {};  // on u of carrier, ring, sun: torque / r
};

// Row vectors of the deflections over all 9 + 3N motions.
Eigen::VectorXd sun_planet_row(const PlanetaryLayout& layout, int n);
Eigen::VectorXd ring_planet_row(const PlanetaryLayout& layout, int n);
Eigen::VectorXd planet_bearing_row(const PlanetaryLayout& layout, int n, int axis);

// M q'' + (C + G) q' + (K + K_inertial) q = f at given stiffness of the 2N pairs (sp1..spN,
// rp1..rpN).
struct PlanetaryMatrices {
    Eigen::MatrixXd mass, damping, stiffness, gyroscopic, centrifugal;
    Eigen::VectorXd force;
};

// Matrices over the layout's degrees of freedom. `torsional` motion ties each planet to the carrier
// (rigid planet bearings) and keeps the rotations: carrier, ring, sun, planets.
PlanetaryMatrices assemble(const PlanetaryLayout& layout, const PlanetaryInputs& inputs,
                           const std::vector<double>& pair_stiffness_N_m);

// The member that `fixed` names.
Body held_body(gears::FixedMember fixed);

// Damping of one pair: 2 zeta sqrt(k m1 m2 / (m1 + m2)) (Liang, Eq. 4.2.5), mu k (Tian, Eq. 4.22)
// or c.
double pair_damping(const PlanetaryLayout& layout, const PlanetaryInputs& inputs, int pair,
                    double stiffness_N_m);

// The motion that deflects nothing: the train turning freely past its held member. It is neutral in
// a real gearbox. The linearised centrifugal term W^2 x lets it grow at a rate near W, since the
// linear model lacks the turn of the bearing pull that cancels it; so the march removes it
// (lockstep/tile).
Eigen::VectorXd rigid_rotation(const PlanetaryLayout& layout);

// Displacements at rest under the load; the free rigid rotation, if any, is left at zero.
Eigen::VectorXd static_equilibrium(const PlanetaryMatrices& matrices);

// Undamped natural frequencies at rest, Hz, ascending; a rigid rotation shows as 0.
std::vector<double> natural_frequencies_Hz(const PlanetaryMatrices& matrices);

}  // namespace gearpod::dynamics
