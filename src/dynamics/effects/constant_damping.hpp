// Constant damping at all mesh phases.
#pragma once

#include "dynamics/effects/damping_law.hpp"

namespace gearpod::dynamics {

struct ConstantDamping {
    static constexpr std::string_view kText = "constant";
    static constexpr DampingParameter kParameters[] = {
        {"mesh_damping_N_s_m", "N_s_m", "N s/m", "constant mesh damping"}};

    static double shape(double) { return 1.0; }
    static DampingTerms terms(const DampingParameters& p, double) { return {p[0]}; }
};

}  // namespace gearpod::dynamics
