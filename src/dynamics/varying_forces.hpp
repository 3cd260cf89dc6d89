// Forces on a gearbox's degrees of freedom that vary while it turns, each a pattern over the
// degrees of freedom times a number that varies.
#pragma once

#include "dynamics/gearbox.hpp"

namespace gearpod::dynamics {

// The external torques in balance, N: what a relative fluctuation of all of them multiplies.
// Neither the pull of the turning carrier nor a weight is part of it.
Eigen::VectorXd torque_force(const GearboxLayout& layout, const GearboxInputs& inputs);

// Weight, N per 1 m/s^2 of gravity along the model's x (column 0) and y (column 1). In a planetary
// train these axes turn with the carrier. Riding planets of a torsional train weigh on
// the carrier's rotation. What would turn the train as one body is left out.
Eigen::MatrixX2d weight_force(const GearboxLayout& layout, const GearboxInputs& inputs);

// The train turning unevenly, N per 1 m/s^2 along rigid_rotation(layout): every mass resists, and
// the torque on degree of freedom `driving` speeds them all up. The train's free rotation feels no
// part of the sum, since it is that rotation that is prescribed.
Eigen::VectorXd uneven_turning_force(const GearboxLayout& layout, const GearboxInputs& inputs,
                                     int driving);

}  // namespace gearpod::dynamics
