// Time-varying forces on a gearbox's degrees of freedom. Each is a pattern over the degrees of
// freedom times a time-varying factor.
#pragma once

#include "dynamics/gearbox.hpp"

namespace gearpod::dynamics {

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
