// How long a step the classical Runge-Kutta method stands on a gearbox.
#pragma once

#include "dynamics/gearbox_matrices.hpp"

namespace gearpod::lockstep {

struct StepLimit {
    double step_s = 0.0;  // longest step that lets no decaying mode grow
    double slowest_decay_1_s =
        0.0;  // smallest decay rate of the vibrating modes; 0 without damping
};

// From the eigenvalues of M q'' + (C + G) q' + (K + K_c) q = 0: |R(h lambda)| <= 1 with
// R(z) = 1 + z + z^2/2 + z^3/6 + z^4/24 for every eigenvalue that does not grow by itself. The
// rigid rotation is left out.
StepLimit runge_kutta_limit(const dynamics::GearboxMatrices& matrices);

}  // namespace gearpod::lockstep
