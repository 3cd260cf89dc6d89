// Damping proportional to stiffness: c = mu k, Tian (2004), Eq. 4.22.
#pragma once

#include "dynamics/effects/damping_law.hpp"

namespace gearpod::dynamics {

struct ProportionalDamping {
    static constexpr std::string_view kText = "proportional to stiffness";
    static constexpr DampingParameter kParameters[] = {
        {"mesh_damping_time_s", "s", "s", "mesh damping time mu in c = mu k"}};

    static double shape(double stiffness_N_m) { return stiffness_N_m; }
    static DampingTerms terms(const DampingParameters& p, double) { return {p[0]}; }
};

}  // namespace gearpod::dynamics
