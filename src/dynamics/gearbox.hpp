// Layout and inputs of a gearbox of any kind; dispatches to the functions of its kind.
#pragma once

#include <span>
#include <string>
#include <variant>
#include <vector>

#include "dynamics/fixed_shaft.hpp"
#include "dynamics/planetary.hpp"
#include "machine/ids.hpp"

namespace gearpod::dynamics {

using GearboxLayout = std::variant<PlanetaryLayout, FixedShaftLayout>;
// Must be of the same kind as the layout.
using GearboxInputs = std::variant<PlanetaryInputs, FixedShaftInputs>;

int degrees_of_freedom(const GearboxLayout& layout);
int pairs(const GearboxLayout& layout);
// Number of locations whose x and y acceleration the sensor's channels record: the planets (and sun
// and carrier if the layout says so), or one bearing.
int sources(const GearboxLayout& layout);
MeshDamping mesh_damping(const GearboxLayout& layout);
double mesh_period_s(const GearboxInputs& inputs);
std::vector<double> mesh_periods_s(std::span<const GearboxInputs> inputs);
double backlash_m(const GearboxInputs& inputs);
// Rotational speed of the frame of x and y: that of the carrier, or 0.
double frame_speed_rad_s(const GearboxInputs& inputs);

// Same as the functions of these names in planetary.hpp and fixed_shaft.hpp. All rows are over the
// degrees of freedom.
GearboxMatrices assemble(const GearboxLayout& layout, const GearboxInputs& inputs,
                         const std::vector<double>& pair_stiffness_N_m);
std::vector<SpringDamper> spring_dampers(const GearboxLayout& layout, const GearboxInputs& inputs,
                                         const std::vector<double>& pair_stiffness_N_m);
Eigen::VectorXd rigid_rotation(const GearboxLayout& layout);
double mesh_damping_factor(const GearboxLayout& layout, const GearboxInputs& inputs, PairId pair);
std::vector<std::string> motion_names(const GearboxLayout& layout);

// Row of a pair's deflection, and of a source's motion along x (axis 0) or y (1).
Eigen::VectorXd mesh_row(const GearboxLayout& layout, PairId pair);
Eigen::VectorXd source_row(const GearboxLayout& layout, int source, int axis);

// Time-varying forces on a gearbox's degrees of freedom. Each is a pattern over the degrees of
// freedom times a time-varying factor.

// External torques in balance, N, to be multiplied by their common relative fluctuation. Excludes
// the centrifugal force of the rotating carrier and the weight.
Eigen::VectorXd torque_force(const GearboxLayout& layout, const GearboxInputs& inputs);

// Weight, N per 1 m/s^2 of gravity along the model's x (column 0) and y (column 1). In a planetary
// train these axes rotate with the carrier. In a torsional train the planets' weight acts on the
// carrier's rotation. The part that would rotate the train as a rigid body is removed.
Eigen::MatrixX2d weight_force(const GearboxLayout& layout, const GearboxInputs& inputs);

// Force under angular acceleration of the train, N per 1 m/s^2 along rigid_rotation(layout): the
// inertia forces of all masses, and the torque on degree of freedom `input_degree` that accelerates
// them. The sum does no work on the free rotation, because that rotation is prescribed.
Eigen::VectorXd angular_acceleration_force(const GearboxLayout& layout, const GearboxInputs& inputs,
                                           int input_degree);

}  // namespace gearpod::dynamics
