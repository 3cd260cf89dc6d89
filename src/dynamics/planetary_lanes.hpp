// Parameters of W planetary gearboxes for the lockstep kernels, as a structure of arrays.
#pragma once

#include <span>

#include "dynamics/planetary.hpp"
#include "machine/lanes.hpp"

namespace gearpod::dynamics {

template <int W, class RealType = double>
struct alignas(64) PlanetaryLanes {
    using Real = RealType;
    // [body][lane]: carrier, ring, sun, then planets 1..N.
    static constexpr int kBodies = 3 + kMaxPlanets;
    Real inverse_mass[kBodies][W];
    Real inverse_inertia[kBodies][W];  // 1 / (J / r^2)
    Real bearing_stiffness[kBodies][W];
    Real bearing_damping[kBodies][W];
    // [carrier, ring, sun][lane]: support of u; zero except for the fixed member.
    Real support_stiffness[3][W];
    Real support_damping[3][W];
    Real force[3][W];
    DampingLanes<W, Real> mesh_damping[kMaxPairs];
    // unloaded position of planet n's bearing, m
    Real pin_x[kMaxPlanets][W], pin_y[kMaxPlanets][W];
    Real speed[W];        // carrier, rad/s
    Real centrifugal[W];  // r_c Omega^2, m/s^2
    Real mesh_period[W];  // s
    Real backlash[W];     // 2b of every mesh, m

    // Data common to all lanes: unit vectors of planet n's radius, sun mesh and ring mesh.
    Real cos_psi[kMaxPlanets], sin_psi[kMaxPlanets];
    Real cos_sun[kMaxPlanets], sin_sun[kMaxPlanets];
    Real cos_ring[kMaxPlanets], sin_ring[kMaxPlanets];
    Real cos_sun_mesh, cos_ring_mesh;  // of the working pressure angles
    Real ring_over_sun_cosine;         // 1 without profile shift
    int planets, sources;
};

// `inputs` holds W gearboxes.
template <int W, class Real = double>
PlanetaryLanes<W, Real> make_lanes(const PlanetaryLayout& layout,
                                   std::span<const PlanetaryInputs> inputs);

}  // namespace gearpod::dynamics
