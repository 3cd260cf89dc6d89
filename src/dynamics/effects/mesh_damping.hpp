// Laws of mesh damping: mesh_dampings.def lists them.
#pragma once

#include <cstddef>
#include <stdexcept>

#include "dynamics/effects/constant_damping.hpp"
#include "dynamics/effects/proportional_damping.hpp"
#include "dynamics/effects/ratio_damping.hpp"
#include "dynamics/effects/rayleigh_damping.hpp"

namespace gearpod::dynamics {

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
