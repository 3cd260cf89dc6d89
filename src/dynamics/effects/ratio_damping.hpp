// Ratio of critical damping: c = 2 zeta sqrt(k m), Liang (2016), Eq. 4.2.5.
#pragma once

#include <cmath>

#include "dynamics/effects/damping_law.hpp"

namespace gearpod::dynamics {

struct RatioDamping {
    static constexpr std::string_view kText = "ratio of critical damping";
    static constexpr DampingParameter kParameters[] = {
        {"mesh_damping_ratio", "", "1",
         "mesh damping ratio zeta in c = 2 zeta sqrt(k m1 m2 / (m1 + m2))"}};

    static double shape(double stiffness_N_m) { return std::sqrt(stiffness_N_m); }
    static DampingTerms terms(const DampingParameters& p, double mass_kg) {
        return {2.0 * p[0] * std::sqrt(mass_kg)};
    }
};

}  // namespace gearpod::dynamics
