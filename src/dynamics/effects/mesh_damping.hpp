// Damping of a tooth mesh as factor(gearbox) times shape(stiffness), one struct per law. The shape
// can thus be tabulated once over the mesh phase for all gearboxes.
#pragma once

#include <cmath>

namespace gearpod::dynamics {

enum class MeshDamping { ratio, proportional, constant };

// c = 2 zeta sqrt(k m1 m2 / (m1 + m2)): Liang (2016), Eq. 4.2.5.
struct RatioDamping {
    static double shape(double stiffness_N_m) { return std::sqrt(stiffness_N_m); }
    static double factor(double zeta, double m1_kg, double m2_kg) {
        return 2.0 * zeta * std::sqrt(m1_kg * m2_kg / (m1_kg + m2_kg));
    }
};

// c = mu k: Tian (2004), Eq. 4.22.
struct ProportionalDamping {
    static double shape(double stiffness_N_m) { return stiffness_N_m; }
    static double factor(double mu_s, double, double) { return mu_s; }
};

// Constant c at all phases.
struct ConstantDamping {
    static double shape(double) { return 1.0; }
    static double factor(double c_N_s_m, double, double) { return c_N_s_m; }
};

// Calls f with the law of `kind`.
template <typename F>
auto with_mesh_damping(MeshDamping kind, F&& f) {
    switch (kind) {
        case MeshDamping::proportional:
            return f(ProportionalDamping{});
        case MeshDamping::constant:
            return f(ConstantDamping{});
        case MeshDamping::ratio:
            break;
    }
    return f(RatioDamping{});
}

inline double mesh_damping_shape(MeshDamping kind, double stiffness_N_m) {
    return with_mesh_damping(kind, [&](auto law) { return law.shape(stiffness_N_m); });
}

}  // namespace gearpod::dynamics
