// Parameters of W planetary gearboxes for the lockstep kernels, as a structure of arrays.
#pragma once

#include <cmath>
#include <span>

#include "dynamics/effects/inertial_terms.hpp"
#include "dynamics/effects/mesh_law.hpp"
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

// Lockstep accelerations of the torsional model with 3 + N rotations: carrier, ring, sun, planets
// 1..N. Bearings are rigid, so planets move with the carrier: x_n = -u_c sin psi_n, y_n = u_c cos
// psi_n. A mesh with working pressure angle alpha thus deflects by -u_c cos(alpha). The planets'
// masses are included in the carrier's inertia (make_lanes).
template <class MeshLaw, int W, class RealType = double>
struct TorsionalMotion {
    using Real = RealType;
    static constexpr int kWidth = W;
    static constexpr int kMaxDegrees = 3 + kMaxPlanets;
    static constexpr int kMaxPairs = dynamics::kMaxPairs;
    static constexpr int kMaxSources = kMaxPlanets;
    using Lanes = PlanetaryLanes<W, Real>;
    using Mesh = MeshLaw;
    using Pairs = typename Mesh::template Pairs<kMaxPairs, W, Real>;

    static GEARPOD_INLINE int degrees_of_freedom(const Lanes& p) { return 3 + p.planets; }
    static GEARPOD_INLINE int sources(const Lanes& p) { return p.planets; }
    static GEARPOD_INLINE const auto& mesh_damping(const Lanes& p, int pair) {
        return p.mesh_damping[pair];
    }

    // a = M^-1 (f - C v - K q). q, v, a: [rotation][lane].
    static GEARPOD_INLINE void accelerations(const Lanes& p, const Real* __restrict q,
                                             const Real* __restrict v, const Pairs& pairs,
                                             Real* __restrict a) {
        for (int body = 0; body < 3; ++body) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                a[body * W + l] =
                    p.force[body][l] - spring_damper(p.support_stiffness[body][l], q[body * W + l],
                                                     p.support_damping[body][l], v[body * W + l]);
            }
        }
        for (int n = 0; n < p.planets; ++n) {
            planet_forces(p, n, q, v, pairs, a);
        }
        for (int body = 0; body < 3; ++body) {
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                a[body * W + l] *= p.inverse_inertia[body][l];
            }
        }
    }

    // Absolute acceleration of the planets along the carrier frame's axes: [planet][x, y][lane].
    static GEARPOD_INLINE void source_accelerations(const Lanes& p, const Real* q, const Real* v,
                                                    const Real* a, Real* __restrict out) {
        for (int n = 0; n < p.planets; ++n) {
            const Real x = -p.sin_psi[n], y = p.cos_psi[n];
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                const Real w = p.speed[l];
                out[2 * n * W + l] = absolute_x(a[l] * x, q[l] * x, v[l] * y, w);
                out[(2 * n + 1) * W + l] = absolute_y(a[l] * y, q[l] * y, v[l] * x, w);
            }
        }
    }

  private:
    static GEARPOD_INLINE void planet_forces(const Lanes& p, int n, const Real* __restrict q,
                                             const Real* __restrict v, const Pairs& pairs,
                                             Real* __restrict f) {
        const Real cs = p.cos_sun_mesh, cr = p.cos_ring_mesh, ratio = p.ring_over_sun_cosine;
        const int o = (3 + n) * W;
        const auto sun_deflection = [=](const Real* z, int l) {
            return std::fma(-z[l], cs, z[2 * W + l] + z[o + l]);
        };
        const auto ring_deflection = [=](const Real* z, int l) {
            return std::fma(-z[l], cr, z[W + l] - z[o + l]);
        };
        const auto sun_force = pair_force<Mesh, W>(pairs, n, sun_deflection, q, v);
        const auto ring_force = pair_force<Mesh, W>(pairs, p.planets + n, ring_deflection, q, v);
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            const Real f_sun = sun_force(pairs, n, l, q, v);
            const Real f_ring = ring_force(pairs, p.planets + n, l, q, v);
            f[l] = std::fma(std::fma(f_ring, ratio, f_sun), cs, f[l]);
            f[W + l] -= f_ring;
            f[2 * W + l] -= f_sun;
            f[o + l] = (f_ring - f_sun) * p.inverse_inertia[planet + n][l];
        }
    }
};

// Lockstep accelerations of the model with 9 + 3N degrees of freedom: x, y and u of carrier, ring,
// sun and planets, written out per spring-damper. The physics is that of the matrices in
// planetary.cpp; tests compare the two.
template <class InertialTerms, class MeshLaw, int W, class RealType = double>
struct TranslationalMotion {
    using Real = RealType;
    static constexpr int kWidth = W;
    static constexpr int kMaxDegrees = 9 + 3 * kMaxPlanets;
    static constexpr int kMaxPairs = dynamics::kMaxPairs;
    static constexpr int kMaxSources = dynamics::kMaxSources;
    using Lanes = PlanetaryLanes<W, Real>;
    using Mesh = MeshLaw;
    using Pairs = typename Mesh::template Pairs<kMaxPairs, W, Real>;

    static GEARPOD_INLINE int degrees_of_freedom(const Lanes& p) { return 9 + 3 * p.planets; }
    static GEARPOD_INLINE int sources(const Lanes& p) { return p.sources; }
    static GEARPOD_INLINE const auto& mesh_damping(const Lanes& p, int pair) {
        return p.mesh_damping[pair];
    }

    // a = M^-1 (f - C v - K q) + inertial terms. q, v, a: [motion][lane].
    static GEARPOD_INLINE void accelerations(const Lanes& p, const Real* __restrict q,
                                             const Real* __restrict v, const Pairs& pairs,
                                             Real* __restrict a) {
        for (int body = 0; body < 3; ++body) {
            central_bearing(p, body, q + 3 * body * W, v + 3 * body * W, a + 3 * body * W);
        }
        for (int n = 0; n < p.planets; ++n) {
            planet_forces(p, n, q, v, pairs, a);
        }
        for (int body = 0; body < 3; ++body) {
            central_acceleration(p, body, q + 3 * body * W, v + 3 * body * W, a + 3 * body * W);
        }
    }

    // Absolute acceleration of the sources along the carrier frame's axes: [source][x, y][lane].
    static GEARPOD_INLINE void source_accelerations(const Lanes& p, const Real* q, const Real* v,
                                                    const Real* a, Real* __restrict out) {
        for (int n = 0; n < p.sources; ++n) {
            const int x = source_motion_index(p.planets, n) * W;
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                const Real w = p.speed[l];
                out[2 * n * W + l] = absolute_x(a[x + l], q[x + l], v[x + W + l], w);
                out[(2 * n + 1) * W + l] = absolute_y(a[x + W + l], q[x + W + l], v[x + l], w);
            }
        }
    }

  private:
    static GEARPOD_INLINE void central_bearing(const Lanes& p, int body, const Real* __restrict q,
                                               const Real* __restrict v, Real* __restrict f) {
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            const Real k = p.bearing_stiffness[body][l];
            const Real c = p.bearing_damping[body][l];
            f[l] = -spring_damper(k, q[l], c, v[l]);
            f[W + l] = -spring_damper(k, q[W + l], c, v[W + l]);
            f[2 * W + l] =
                p.force[body][l] - spring_damper(p.support_stiffness[body][l], q[2 * W + l],
                                                 p.support_damping[body][l], v[2 * W + l]);
        }
    }

    static GEARPOD_INLINE void central_acceleration(const Lanes& p, int body,
                                                    const Real* __restrict q,
                                                    const Real* __restrict v, Real* __restrict a) {
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            const Real w = p.speed[l];
            a[l] = std::fma(a[l], p.inverse_mass[body][l], InertialTerms::x(q[l], v[W + l], w));
            a[W + l] =
                std::fma(a[W + l], p.inverse_mass[body][l], InertialTerms::y(q[W + l], v[l], w));
            a[2 * W + l] *= p.inverse_inertia[body][l];
        }
    }

    // Adds the forces of both meshes and the bearing of planet n. Completes its accelerations, and
    // adds the reactions to the forces on carrier, ring and sun.
    static GEARPOD_INLINE void planet_forces(const Lanes& p, int n, const Real* __restrict q,
                                             const Real* __restrict v, const Pairs& pairs,
                                             Real* __restrict f) {
        const int o = (9 + 3 * n) * W;
        const Real cs = p.cos_sun[n], ss = p.sin_sun[n];
        const Real cr = p.cos_ring[n], sr = p.sin_ring[n];
        const Real cp = p.cos_psi[n], sp = p.sin_psi[n];
        const auto sun_deflection = [=](const Real* z, int l) {
            return std::fma(
                z[6 * W + l] - z[o + l], cs,
                std::fma(z[7 * W + l] - z[o + W + l], ss, z[8 * W + l] + z[o + 2 * W + l]));
        };
        const auto ring_deflection = [=](const Real* z, int l) {
            return std::fma(
                z[3 * W + l] - z[o + l], cr,
                std::fma(z[4 * W + l] - z[o + W + l], sr, z[5 * W + l] - z[o + 2 * W + l]));
        };
        const auto sun_force = pair_force<Mesh, W>(pairs, n, sun_deflection, q, v);
        const auto ring_force = pair_force<Mesh, W>(pairs, p.planets + n, ring_deflection, q, v);
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            const Real x = q[o + l], y = q[o + W + l];
            const Real vx = v[o + l], vy = v[o + W + l];
            const Real f_sun = sun_force(pairs, n, l, q, v);
            const Real f_ring = ring_force(pairs, p.planets + n, l, q, v);

            const Real kb = p.bearing_stiffness[planet + n][l];
            const Real cb = p.bearing_damping[planet + n][l];
            const Real f_x = spring_damper(kb, std::fma(q[2 * W + l], sp, x - q[l]) - p.pin_x[n][l],
                                           cb, std::fma(v[2 * W + l], sp, vx - v[l]));
            const Real f_y =
                spring_damper(kb, std::fma(-q[2 * W + l], cp, y - q[W + l]) - p.pin_y[n][l], cb,
                              std::fma(-v[2 * W + l], cp, vy - v[W + l]));

            f[l] += f_x;
            f[W + l] += f_y;
            f[2 * W + l] = std::fma(f_y, cp, std::fma(-f_x, sp, f[2 * W + l]));
            f[3 * W + l] = std::fma(-f_ring, cr, f[3 * W + l]);
            f[4 * W + l] = std::fma(-f_ring, sr, f[4 * W + l]);
            f[5 * W + l] -= f_ring;
            f[6 * W + l] = std::fma(-f_sun, cs, f[6 * W + l]);
            f[7 * W + l] = std::fma(-f_sun, ss, f[7 * W + l]);
            f[8 * W + l] -= f_sun;

            const Real w = p.speed[l];
            const Real centrifugal_acceleration = p.centrifugal[l];
            f[o + l] = std::fma(
                std::fma(f_sun, cs, std::fma(f_ring, cr, -f_x)), p.inverse_mass[planet + n][l],
                InertialTerms::x(x, vy, w) +
                    InertialTerms::centrifugal_acceleration(centrifugal_acceleration, cp));
            f[o + W + l] = std::fma(
                std::fma(f_sun, ss, std::fma(f_ring, sr, -f_y)), p.inverse_mass[planet + n][l],
                InertialTerms::y(y, vx, w) +
                    InertialTerms::centrifugal_acceleration(centrifugal_acceleration, sp));
            f[o + 2 * W + l] = (f_ring - f_sun) * p.inverse_inertia[planet + n][l];
        }
    }
};

}  // namespace gearpod::dynamics
