// Laws of mesh damping. A law is a struct with
// - kText, its name in descriptions, and kParameters, its parameters in study files;
// - shape(k), the part of the damping that depends on the mesh stiffness k, N/m;
// - terms(p, m), how much of it a gearbox has: p are its parameters and m is the equivalent mass
//   m1 m2 / (m1 + m2) of the two gears, kg.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string_view>

#include "machine/ids.hpp"

namespace gearpod::dynamics {

// Damping of a mesh, N s/m: factor times the law's shape of its stiffness, plus constant. The shape
// can thus be tabulated once over the mesh phase for all gearboxes.
struct DampingTerms {
    double factor = 0.0, constant = 0.0;
};

// Values of a law's parameters in SI units; the others are 0.
inline constexpr int kMostDampingParameters = 2;
using DampingParameters = std::array<double, kMostDampingParameters>;

// The same of W gearboxes.
template <int W, class Real = double>
struct DampingLanes {
    Real factor[W], constant[W];

    void set(LaneId lane, const DampingTerms& terms) {
        factor[lane] = Real(terms.factor);
        constant[lane] = Real(terms.constant);
    }
};

struct DampingParameter {
    std::string_view key;     // "mesh_damping_time_s"
    std::string_view suffix;  // unit at the end of the key, "" for a pure number
    std::string_view unit;    // "s"; "1" for a pure number
    std::string_view doc;
};

// Constant damping at all mesh phases.
struct ConstantDamping {
    static constexpr std::string_view kText = "constant";
    static constexpr DampingParameter kParameters[] = {
        {"mesh_damping_N_s_m", "N_s_m", "N s/m", "constant mesh damping"}};

    static double shape(double) { return 1.0; }
    static DampingTerms terms(const DampingParameters& p, double) { return {p[0]}; }
};

// Damping proportional to stiffness: c = mu k, Tian (2004), Eq. 4.22.
struct ProportionalDamping {
    static constexpr std::string_view kText = "proportional to stiffness";
    static constexpr DampingParameter kParameters[] = {
        {"mesh_damping_time_s", "s", "s", "mesh damping time mu in c = mu k"}};

    static double shape(double stiffness_N_m) { return stiffness_N_m; }
    static DampingTerms terms(const DampingParameters& p, double) { return {p[0]}; }
};

// Ratio of critical damping: c = 2 zeta sqrt(k m), Liang (2016), Eq. 4.2.5.
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

// Rayleigh damping of the two gears that vibrate against one another: c = alpha m + beta k with
// their equivalent mass m. A mode in which the gears do not turn has the damping ratio
// alpha / (2 w) + beta w / 2 at its natural frequency w, rad/s. Rayleigh, The Theory of
// Sound, vol. 1 (1877).
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

// Damping of a mesh between gears of mass m1 and m2, N s/m.
inline DampingTerms mesh_damping_terms(MeshDamping kind, const DampingParameters& parameters,
                                       double m1_kg, double m2_kg) {
    return with_mesh_damping(
        kind, [&](auto law) { return law.terms(parameters, m1_kg * m2_kg / (m1_kg + m2_kg)); });
}
inline double mesh_damping_N_s_m(MeshDamping kind, const DampingTerms& terms,
                                 double stiffness_N_m) {
    return with_mesh_damping(
        kind, [&](auto law) { return terms.factor * law.shape(stiffness_N_m) + terms.constant; });
}

}  // namespace gearpod::dynamics
