// One-stage fixed-shaft gearbox with 8 degrees of freedom between a motor and a load, as matrices.
// Tian (2004), Eqs. 4.1-4.8.
//
// Order of the motions q: x_1 y_1 x_2 y_2 (m; 1 the pinion, 2 the gear, y along the line of action)
// and u_m u_1 u_2 u_b (m) of motor, pinion, gear and load. u = R_b theta with the pinion's base
// radius for motor and pinion, and the gear's for gear and load. The mesh thus deflects by u_1 -
// u_2 - y_1 + y_2. Every spring-damper acts on both its ends. Eq. 4.4 prints the mesh force on the
// gear with the sign of that on the pinion, which would create energy.
#pragma once

#include <string>
#include <vector>

#include "dynamics/effects/mesh_damping.hpp"
#include "dynamics/effects/mesh_law.hpp"
#include "dynamics/eigen_forward.hpp"

namespace gearpod::dynamics {

struct GearboxMatrices;
struct SpringDamper;

// Order of the gears in arrays.
inline constexpr int pinion = 0, gear = 1, fixed_shaft_gear_count = 2;

// Indices in q.
enum FixedShaftMotion { x_1, y_1, x_2, y_2, u_m, u_1, u_2, u_b, fixed_shaft_motions };

// Properties common to all gearboxes of an ensemble.
struct FixedShaftLayout {
    double base_radius_m[fixed_shaft_gear_count] = {};
    MeshDamping mesh_damping = MeshDamping::proportional;
    int sensor = pinion;  // gear whose bearing carries the sensor

    int pairs() const { return 1; }
    int sources() const { return 1; }
    int degrees_of_freedom() const { return fixed_shaft_motions; }
};

// Parameters that differ between gearboxes; SI units. Arrays are in the order of the gears.
// Bearings are equal in x and y. Couplings connect the motor with the pinion, and the gear with the
// load.
struct FixedShaftInputs {
    double mass_kg[fixed_shaft_gear_count] = {};
    double inertia_kg_m2[fixed_shaft_gear_count] = {};
    double bearing_stiffness_N_m[fixed_shaft_gear_count] = {};
    double bearing_damping_N_s_m[fixed_shaft_gear_count] = {};
    double coupling_stiffness_N_m_rad[fixed_shaft_gear_count] = {};
    double coupling_damping_N_m_s_rad[fixed_shaft_gear_count] = {};
    double motor_inertia_kg_m2 = 0.0, load_inertia_kg_m2 = 0.0;
    double motor_torque_N_m = 0.0, load_torque_N_m = 0.0;  // directions as in Eqs. 4.7-4.8
    double mesh_damping = 0.0;                             // parameter of the layout's law
    double mesh_period_s = 0.0;
    double backlash_m = kNoBackContact;  // 2b along the line of action; for separating meshes
};

// Row of the mesh's deflection.
Eigen::VectorXd mesh_row(const FixedShaftLayout& layout);

std::vector<SpringDamper> spring_dampers(const FixedShaftLayout& layout,
                                         const FixedShaftInputs& inputs,
                                         const std::vector<double>& pair_stiffness_N_m);

// Assembles the matrices. Unbalanced torques would also accelerate the whole train, which
// contradicts the steady mesh period. The force is therefore only the part of the load that excites
// vibration, f - M phi (phi . f) / (phi . M phi) with the rigid rotation phi; it does no work on
// phi.
GearboxMatrices assemble(const FixedShaftLayout& layout, const FixedShaftInputs& inputs,
                         const std::vector<double>& pair_stiffness_N_m);

double mesh_damping_factor(const FixedShaftLayout& layout, const FixedShaftInputs& inputs,
                           PairId pair);

// Equal rotation of all four bodies, which deflects no spring.
Eigen::VectorXd rigid_rotation(const FixedShaftLayout& layout);

// Names of the degrees of freedom: pinion_x, pinion_y, ...
std::vector<std::string> motion_names(const FixedShaftLayout& layout);

}  // namespace gearpod::dynamics
