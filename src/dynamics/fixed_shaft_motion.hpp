// Motion of W fixed-shaft gearboxes in lockstep: their parameters as a structure of arrays, and the
// equations of motion.
#pragma once

#include <span>

#include "dynamics/effects/mesh_law.hpp"
#include "dynamics/fixed_shaft.hpp"
#include "machine/lanes.hpp"

namespace gearpod::dynamics {

// Parameters of W fixed-shaft gearboxes for the lockstep kernels, as a structure of arrays.
template <int W, class RealType = double>
struct alignas(64) FixedShaftLanes {
    using Real = RealType;
    // [motion][lane].
    Real inverse_mass[fixed_shaft_motions][W];
    Real force[fixed_shaft_motions][W];
    // [pinion, gear][lane]; those of the couplings are divided by R_b^2.
    Real bearing_stiffness[fixed_shaft_gear_count][W];
    Real bearing_damping[fixed_shaft_gear_count][W];
    Real coupling_stiffness[fixed_shaft_gear_count][W];
    Real coupling_damping[fixed_shaft_gear_count][W];
    DampingLanes<W, Real> mesh_damping;
    Real mesh_period[W];  // s
    Real backlash[W];     // 2b of the mesh, m
    int sensor;           // pinion or gear
};

// `inputs` holds W gearboxes.
template <int W, class Real = double>
FixedShaftLanes<W, Real> make_lanes(const FixedShaftLayout& layout,
                                    std::span<const FixedShaftInputs> inputs);

// Lockstep accelerations of the fixed-shaft gearbox, written out per spring-damper. The physics is
// that of the matrices in fixed_shaft.cpp; tests compare the two. Tian (2004), Eqs. 4.1-4.8.
template <class MeshLaw, int W, class RealType = double>
struct FixedShaftMotions {
    using Real = RealType;
    static constexpr int kWidth = W;
    static constexpr int kMaxDegrees = fixed_shaft_motions;
    static constexpr int kMaxPairs = 1;
    static constexpr int kMaxSources = 1;
    using Lanes = FixedShaftLanes<W, Real>;
    using Mesh = MeshLaw;
    using Pairs = typename Mesh::template Pairs<kMaxPairs, W, Real>;

    static GEARPOD_INLINE int degrees_of_freedom(const Lanes&) { return fixed_shaft_motions; }
    static GEARPOD_INLINE int sources(const Lanes&) { return 1; }
    static GEARPOD_INLINE const auto& mesh_damping(const Lanes& p, int) { return p.mesh_damping; }

    // a = M^-1 (f - C v - K q). q, v, a: [motion][lane].
    static GEARPOD_INLINE void accelerations(const Lanes& p, const Real* __restrict q,
                                             const Real* __restrict v, const Pairs& pairs,
                                             Real* __restrict a) {
        const auto deflection = [](const Real* z, int l) {
            return (at(z, u_1, l) - at(z, u_2, l)) - (at(z, y_1, l) - at(z, y_2, l));
        };
        const auto teeth = pair_force<Mesh, W>(pairs, 0, deflection, q, v);
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            const Real mesh = teeth(pairs, 0, l, q, v);
            const Real motor =
                spring_damper(p.coupling_stiffness[pinion][l], at(q, u_m, l) - at(q, u_1, l),
                              p.coupling_damping[pinion][l], at(v, u_m, l) - at(v, u_1, l));
            const Real load =
                spring_damper(p.coupling_stiffness[gear][l], at(q, u_2, l) - at(q, u_b, l),
                              p.coupling_damping[gear][l], at(v, u_2, l) - at(v, u_b, l));
            set(p, a, x_1, l, -bearing(p, pinion, q, v, x_1, l));
            set(p, a, y_1, l, mesh - bearing(p, pinion, q, v, y_1, l));
            set(p, a, x_2, l, -bearing(p, gear, q, v, x_2, l));
            set(p, a, y_2, l, -mesh - bearing(p, gear, q, v, y_2, l));
            set(p, a, u_m, l, -motor);
            set(p, a, u_1, l, motor - mesh);
            set(p, a, u_2, l, mesh - load);
            set(p, a, u_b, l, load);
        }
    }

    // Acceleration of the sensor's bearing along x and y: [axis][lane].
    static GEARPOD_INLINE void source_accelerations(const Lanes& p, const Real*, const Real*,
                                                    const Real* __restrict a,
                                                    Real* __restrict out) {
        const Real* __restrict sensed = a + 2 * p.sensor * W;
#pragma omp simd
        for (int i = 0; i < 2 * W; ++i) {
            out[i] = sensed[i];
        }
    }

  private:
    static GEARPOD_INLINE Real at(const Real* x, int motion, int l) {
        return x[motion * W + l];
    }
    static GEARPOD_INLINE Real bearing(const Lanes& p, int g, const Real* q, const Real* v,
                                       int motion, int l) {
        return spring_damper(p.bearing_stiffness[g][l], at(q, motion, l), p.bearing_damping[g][l],
                             at(v, motion, l));
    }
    static GEARPOD_INLINE void set(const Lanes& p, Real* a, int motion, int l, Real force) {
        a[motion * W + l] = (p.force[motion][l] + force) * p.inverse_mass[motion][l];
    }
};

}  // namespace gearpod::dynamics
