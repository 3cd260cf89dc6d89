// Laws of mesh damping. A law is a struct with
// - kText, its name in descriptions, and kParameter, its parameter in study files;
// - shape(k), the part of the damping that depends on the mesh stiffness k, N/m;
// - factor(p, m), by which a gearbox multiplies it: p is its parameter and m is the equivalent mass
//   m1 m2 / (m1 + m2) of the two gears, kg.
#pragma once

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string_view>

#include "machine/ids.hpp"

namespace gearpod::dynamics {

// Damping of a mesh, N s/m: factor times the law's shape of its stiffness. The shape can thus be
// tabulated once over the mesh phase for all gearboxes. Factors of W gearboxes:
template <int W, class Real = double>
struct DampingLanes {
    Real factor[W];
};

struct DampingParameter {
    std::string_view key;     // "mesh_damping_time_s"
    std::string_view suffix;  // unit at the end of the key, "" for a pure number
    std::string_view unit;    // "s"; "1" for a pure number
    std::string_view doc;
};

// Damping proportional to stiffness: c = mu k, Tian (2004), Eq. 4.22.
struct ProportionalDamping {
    static constexpr std::string_view kText = "proportional to stiffness";
    static constexpr DampingParameter kParameter{"mesh_damping_time_s", "s", "s",
                                                 "mesh damping time mu in c = mu k"};

    static double shape(double stiffness_N_m) { return stiffness_N_m; }
    static double factor(double time_s, double) { return time_s; }
};

// Ratio of critical damping: c = 2 zeta sqrt(k m), Liang (2016), Eq. 4.2.5.
struct RatioDamping {
    static constexpr std::string_view kText = "ratio of critical damping";
    static constexpr DampingParameter kParameter{
        "mesh_damping_ratio", "", "1",
        "mesh damping ratio zeta in c = 2 zeta sqrt(k m1 m2 / (m1 + m2))"};

    static double shape(double stiffness_N_m) { return std::sqrt(stiffness_N_m); }
    static double factor(double ratio, double mass_kg) { return 2.0 * ratio * std::sqrt(mass_kg); }
};

// Laws of mesh damping: mesh_dampings.def lists them.
enum class MeshDamping {
#define GEARPOD_MESH_DAMPING(NAME, LAW) NAME,
#include "dynamics/effects/mesh_dampings.def"
#undef GEARPOD_MESH_DAMPING
};

inline constexpr std::size_t kMeshDampings = 0
#define GEARPOD_MESH_DAMPING(NAME, LAW) +1
#include "dynamics/effects/mesh_dampings.def"
#undef GEARPOD_MESH_DAMPING
    ;

// Calls f with the law of `kind`.
template <typename F>
auto with_mesh_damping(MeshDamping kind, F&& f) {
    switch (kind) {
#define GEARPOD_MESH_DAMPING(NAME, LAW) \
    case MeshDamping::NAME:             \
        return f(LAW{});
#include "dynamics/effects/mesh_dampings.def"
#undef GEARPOD_MESH_DAMPING
    }
    throw std::invalid_argument("unknown law of mesh damping");
}

// Factor of a mesh between gears of mass m1 and m2.
inline double mesh_damping_factor(MeshDamping kind, double parameter, double m1_kg, double m2_kg) {
    return with_mesh_damping(
        kind, [&](auto law) { return law.factor(parameter, m1_kg * m2_kg / (m1_kg + m2_kg)); });
}
inline double mesh_damping_N_s_m(MeshDamping kind, double factor, double stiffness_N_m) {
    return with_mesh_damping(kind, [&](auto law) { return factor * law.shape(stiffness_N_m); });
}

}  // namespace gearpod::dynamics
