// Natural frequencies of a gearbox whose frame of reference turns with the carrier.
#pragma once

#include <vector>

#include "dynamics/gearbox_matrices.hpp"

namespace gearpod::dynamics {

// Natural frequencies, Hz, ascending, one per degree of freedom: undamped, as seen in the turning
// frame, with gyroscopic and centrifugal terms. 0 for motions that do not oscillate. The
// eigenvalues of M q'' + G q' + (K + K_inertial) q = 0 follow from its first-order form (L.
// Meirovitch, Methods of Analytical Dynamics).
std::vector<double> rotating_frequencies_Hz(const GearboxMatrices& matrices);

}  // namespace gearpod::dynamics
