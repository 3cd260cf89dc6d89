// Equations of motion of a gearbox of any kind, M q'' + (C + G) q' + (K + K_inertial) q = f, and
// what follows from them at rest.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace gearpod::dynamics {

// A spring and a damper side by side on the deflection d = row . q: adds k row row^T to K and
// c row row^T to C, so that both are symmetric and what deflects nothing costs no energy.
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

// All matrices and the force zero.
GearboxMatrices zero_matrices(int motions);

void add(GearboxMatrices& matrices, const SpringDamper& spring);

// Displacements at rest under the load; the free rigid rotation, if any, is left at zero.
Eigen::VectorXd static_equilibrium(const GearboxMatrices& matrices);

// Undamped natural frequencies at rest, Hz, ascending; a rigid rotation shows as 0.
std::vector<double> natural_frequencies_Hz(const GearboxMatrices& matrices);

}  // namespace gearpod::dynamics
