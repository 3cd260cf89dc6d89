// Bodies of Lin and Parker's gearbox (1999) from Liang (2016), Table 4.2: carrier, ring, sun,
// planet.
#pragma once

#include "dynamics/planetary.hpp"

namespace test_gearbox {

inline gearpod::dynamics::PlanetaryInputs lin_parker_inputs() {
    gearpod::dynamics::PlanetaryInputs in;
    const double masses[] = {5.43, 2.35, 0.40, 0.66};
    const double inertias[] = {6.29, 3.00, 0.39, 0.61};
    for (int body = 0; body < gearpod::dynamics::body_count; ++body) {
        in.mass_kg[body] = masses[body];
        in.inertia_over_r2_kg[body] = inertias[body];
        in.bearing_stiffness_N_m[body] = 1e8;
    }
    in.support_stiffness_N_m = 1e9;
    return in;
}

}  // namespace test_gearbox
