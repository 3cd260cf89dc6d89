// Lockstep accelerations of the torsional model with 3 + N rotations: carrier, ring, sun, planets
// 1..N. Bearings are rigid, so planets move with the carrier: x_n = -u_c sin psi_n, y_n = u_c cos
// psi_n. A mesh with working pressure angle alpha thus deflects by -u_c cos(alpha). The planets'
// masses are included in the carrier's inertia (make_lanes).
#pragma once

#include <cmath>

#include "dynamics/effects/inertial_terms.hpp"
#include "dynamics/effects/mesh_law.hpp"
#include "dynamics/planetary_lanes.hpp"

namespace gearpod::dynamics {

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
        const auto sun = pair_force<Mesh, W>(pairs, n, sun_deflection, q, v);
        const auto ring = pair_force<Mesh, W>(pairs, p.planets + n, ring_deflection, q, v);
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            const Real f_sun = sun(pairs, n, l, q, v);
            const Real f_ring = ring(pairs, p.planets + n, l, q, v);
            f[l] = std::fma(std::fma(f_ring, ratio, f_sun), cs, f[l]);
            f[W + l] -= f_ring;
            f[2 * W + l] -= f_sun;
            f[o + l] = (f_ring - f_sun) * p.inverse_inertia[planet + n][l];
        }
    }
};

}  // namespace gearpod::dynamics
