// Matrices of a gearbox of any kind: equations of motion, static equilibrium and natural
// frequencies. The Eigen templates are instantiated only in the source of this header, because they
// take longer to compile than a kernel.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace gearpod::dynamics {

struct EigenPairs {
    Eigen::VectorXcd values;
    Eigen::MatrixXcd vectors;  // one per column
};

struct Modes {
    Eigen::VectorXd squares;  // natural angular frequencies squared, (rad/s)^2, ascending
    Eigen::MatrixXd shapes;   // one per column
};

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix);
EigenPairs eigen_pairs(const Eigen::MatrixXd& matrix);
Eigen::MatrixXd inverse(const Eigen::MatrixXd& matrix);
// Minimum-norm solution.
Eigen::VectorXd solve(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);
// Undamped modes of symmetric matrices.
Modes modes(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass);
bool positive_definite(const Eigen::MatrixXd& matrix);

// Equations of motion of a gearbox of any kind, M q'' + (C + G) q' + (K + K_inertial) q = f.
// Includes static equilibrium and natural frequencies.

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

// Natural frequencies of a gearbox whose frame of reference turns with the carrier.

// Natural frequencies, Hz, ascending, one per degree of freedom: undamped, as seen in the turning
// frame, with gyroscopic and centrifugal terms. 0 for motions that do not oscillate. The
// eigenvalues of M q'' + G q' + (K + K_inertial) q = 0 follow from its first-order form (L.
// Meirovitch, Methods of Analytical Dynamics).
std::vector<double> rotating_frequencies_Hz(const GearboxMatrices& matrices);

}  // namespace gearpod::dynamics
