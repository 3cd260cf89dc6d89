// Rayleigh damping of the two gears that vibrate against one another: c = alpha m + beta k with
// their equivalent mass m. A mode in which the gears do not turn has the damping ratio
// alpha / (2 w) + beta w / 2 at its natural frequency w, rad/s. Rayleigh, The Theory of
// Sound, vol. 1 (1877).
#pragma once

#include "dynamics/effects/damping_law.hpp"

namespace gearpod::dynamics {

struct RayleighDamping {
    static constexpr std::string_view kText = "Rayleigh: proportional to mass and stiffness";
    static constexpr DampingParameter kParameters[] = {
        {"mesh_damping_alpha_1_s", "1_s", "1/s",
         "mesh damping alpha in c = alpha m1 m2 / (m1 + m2) + beta k"},
        {"mesh_damping_beta_s", "s", "s",
         "mesh damping beta in c = alpha m1 m2 / (m1 + m2) + beta k"}};

    static double shape(double stiffness_N_m) { return stiffness_N_m; }
    static DampingTerms terms(const DampingParameters& p, double mass_kg) {
        return {p[1], p[0] * mass_kg};
    }
};

}  // namespace gearpod::dynamics
