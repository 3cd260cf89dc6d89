// Parameters of W planetary gearboxes, structure of arrays, as the lockstep kernels read them.
#pragma once

#include <span>

#include "dynamics/planetary.hpp"

namespace gearpod::dynamics {

template <int W>
struct alignas(64) PlanetaryLanes {
    // [body][lane]: carrier, ring, sun, planet.
    double inverse_mass[body_count][W];
    double inverse_inertia[body_count][W];  // 1 / (J / r^2)
    double bearing_stiffness[body_count][W];
    double bearing_damping[body_count][W];
    // [carrier, ring, sun][lane]: support of u; zero but for the held member.
    double support_stiffness[3][W];
    double support_damping[3][W];
    double force[3][W];
    double mesh_damping_factor[2][W];  // sun-planet, ring-planet: times the shape of the stiffness
    double speed[W];                   // carrier, rad/s
    double centrifugal[W];             // r_c Omega^2, m/s^2
    double mesh_period[W];             // s
    double backlash[W];                // 2b of every mesh, m

    // Shared by all lanes: unit vectors of planet n's radius, sun mesh and ring mesh.
    double cos_psi[kMaxPlanets], sin_psi[kMaxPlanets];
    double cos_sun[kMaxPlanets], sin_sun[kMaxPlanets];
    double cos_ring[kMaxPlanets], sin_ring[kMaxPlanets];
    double cos_pressure_angle;
    int planets;
};

// `inputs` holds W gearboxes.
template <int W>
PlanetaryLanes<W> make_lanes(const PlanetaryLayout& layout,
                             std::span<const PlanetaryInputs> inputs);

extern template PlanetaryLanes<1> make_lanes<1>(const PlanetaryLayout&,
                                                std::span<const PlanetaryInputs>);
extern template PlanetaryLanes<4> make_lanes<4>(const PlanetaryLayout&,
                                                std::span<const PlanetaryInputs>);
extern template PlanetaryLanes<8> make_lanes<8>(const PlanetaryLayout&,
                                                std::span<const PlanetaryInputs>);

}  // namespace gearpod::dynamics
