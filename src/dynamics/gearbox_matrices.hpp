// Equations of motion of a gearbox of any kind, M q'' + (C + G) q' + (K + K_inertial) q = f.
// Includes static equilibrium and natural frequencies.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace gearpod::dynamics {

// Spring and damper in parallel on the deflection d = row . q. It adds k row row^T to K and c row
// row^T to C, so both stay symmetric, and motions without deflection need no energy.
struct SpringDamper {
    std::string name;  // as in "the motor coupling"
    Eigen::VectorXd row;
    double stiffness = 0.0;  // N/m
    double damping = 0.0;    // N s/m
};

struct GearboxMatrices {
    Eigen::MatrixXd mass, damping, stiffness, gyroscopic, centrifugal;
    Eigen::VectorXd force;
};

// Matrices and force, all zero.
GearboxMatrices zero_matrices(int motions);

void add(GearboxMatrices& matrices, const SpringDamper& spring);

// Static displacements under the load, without any free rigid rotation.
Eigen::VectorXd static_equilibrium(const GearboxMatrices& matrices);

// Undamped natural frequencies without rotation of the frame, Hz, ascending; that of a rigid
// rotation is 0.
std::vector<double> natural_frequencies_Hz(const GearboxMatrices& matrices);

}  // namespace gearpod::dynamics
