// Laws of the mesh force: linear, with separation, and with unilateral contact of each tooth pair.
#pragma once

#include <cmath>
#include <limits>

#include "machine/instruction_sets.hpp"

namespace gearpod::dynamics {

// Force for deflection d and rate r.
template <class Real>
GEARPOD_INLINE Real spring_damper(Real k, Real d, Real c, Real r) {
    return std::fma(k, d, c * r);
}

// Force of a tooth mesh as a function of its deflection d and its rate r, one struct per law. A
// positive force is compressive. e is the static transmission error of the pair: the gap between
// its flanks in unloaded uniform rotation, in metres along the line of action.
//
// Sources: Yang (2022), Eqs. 71-72, except that a mesh out of contact has no damping force either;
// Ambarisha and Parker (2007) for the law without back contact.
//
// Unilateral contact: each tooth pair, or each slice of it, is a spring that transmits only
// compression. With stiffness k_j and gap e_j it carries k_j max(0, d - e - e_j) (the thin-slice
// and contact models of Velex and Maatar, J. Sound Vib. 191, 1996). For pairs coupled through
// elastic gear bodies, k_j are the values with all of them in contact.

// Mesh laws:
// - linear: k d + c d'.
// - with_error: k (d - e) + c (d' - e').
// - separating: the same while d - e > 0; zero in the gap; on the back flanks k (d - e + 2b) + c
//   (d' - e') once d - e < -2b.
// - unilateral: on the front flanks the sum of k_j max(0, d - e - e_j), with c (d' - e') while any
//   spring is in contact; on the back flanks as separating.
enum class MeshLaw {
#define GEARPOD_MESH_LAW(NAME, ...) NAME,
#include "dynamics/effects/mesh_laws.def"
#undef GEARPOD_MESH_LAW
};

// Backlash 2b of a mesh that never touches on its back flanks.
inline constexpr double kNoBackContact = std::numeric_limits<double>::infinity();

// Limits for unilateral contact: tooth pairs of a gear pair engaged at once, and springs of all of
// them and their slices.
inline constexpr int kMostToothPairs = 8;
inline constexpr int kMostContacts = 72;

// Each law states whether it has an error of the pair, whether flanks can separate, and whether it
// has single tooth pairs. `Pairs` holds the data of all gear pairs at one instant, [pair][lane].
struct LinearMesh {
    static constexpr bool kHasError = false;
    static constexpr bool kSeparates = false;
    static constexpr bool kHasTeeth = false;

    template <int kPairs, int W, class Real = double>
    struct alignas(64) Pairs {
        Real k[kPairs * W], c[kPairs * W];
    };
    // i = pair W + lane.
    template <class Pairs, class Real>
    static GEARPOD_INLINE Real force(const Pairs& m, int i, int /*lane*/, Real d, Real r) {
        return spring_damper(m.k[i], d, m.c[i], r);
    }
};

struct LinearMeshWithError {
    static constexpr bool kHasError = true;
    static constexpr bool kSeparates = false;
    static constexpr bool kHasTeeth = false;

    template <int kPairs, int W, class Real = double>
    struct alignas(64) Pairs {
        Real k[kPairs * W], c[kPairs * W];
        Real e[kPairs * W], de[kPairs * W];  // error, m, and its rate, m/s
    };
    template <class Pairs, class Real>
    static GEARPOD_INLINE Real force(const Pairs& m, int i, int /*lane*/, Real d, Real r) {
        return spring_damper(m.k[i], d - m.e[i], m.c[i], r - m.de[i]);
    }
};

struct SeparatingMesh {
    static constexpr bool kHasError = true;
    static constexpr bool kSeparates = true;
    static constexpr bool kHasTeeth = false;

    template <int kPairs, int W, class Real = double>
    struct alignas(64) Pairs {
        Real k[kPairs * W], c[kPairs * W];
        Real e[kPairs * W], de[kPairs * W];
        Real backlash[W];
    };
    template <class Pairs, class Real>
    static GEARPOD_INLINE Real force(const Pairs& m, int i, int lane, Real d, Real r) {
        const Real none = 0;
        const Real front = d - m.e[i];
        const Real back = front + m.backlash[lane];
        const Real compression = front > none ? front : back < none ? back : none;
        const Real rate = compression != none ? r - m.de[i] : none;
        return spring_damper(m.k[i], compression, m.c[i], rate);
    }
};

// Sum of springs over the tooth pairs; k and c are the totals.
struct UnilateralContact {
    static constexpr bool kHasError = true;
    static constexpr bool kSeparates = true;
    static constexpr bool kHasTeeth = true;

    template <int kPairs, int W, class Real = double>
    struct alignas(64) Pairs {
        static constexpr int kRows = kPairs * W;
        Real k[kRows], c[kRows];
        Real e[kRows], de[kRows];
        // [contact][pair][lane], N/m and m; the stiffness is 0 where no tooth pair is engaged.
        Real tooth_k[kMostContacts * kRows], tooth_e[kMostContacts * kRows];
        // Gap of a tooth pair in the middle of its path of contact, and its growth along the path,
        // m. Both are constant during the steps [constant_from, constant_until).
        Real gap[kMostToothPairs * kRows], growth[kMostToothPairs * kRows];
        Real backlash[W];
        int contacts = 1;  // number in use
        int constant_from = 0, constant_until = 0;
    };
    // Forces of one gear pair in all lanes, N, from its deflections and their rates, [lane].
    template <int W, class Pairs, class Real>
    static GEARPOD_INLINE void forces(const Pairs& m, int pair, const Real* __restrict d,
                                      const Real* __restrict r, Real* __restrict f) {
        const Real none = 0;
        alignas(64) Real front[W];
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            front[l] = d[l] - m.e[pair * W + l];
            f[l] = none;
        }
        for (int j = m.contacts - 1; j >= 0; --j) {
            const Real* __restrict k = m.tooth_k + j * Pairs::kRows + pair * W;
            const Real* __restrict gap = m.tooth_e + j * Pairs::kRows + pair * W;
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                const Real compression = front[l] - gap[l];
                f[l] = std::fma(k[l], compression > none ? compression : none, f[l]);
            }
        }
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            const int i = pair * W + l;
            const Real back = front[l] + m.backlash[l];
            const Real compression = back < none ? std::fma(m.k[i], back, f[l]) : f[l];
            const Real rate = compression != none ? r[l] - m.de[i] : none;
            f[l] = std::fma(m.c[i], rate, compression);
        }
    }
};

// Force of one gear pair in a loop over lanes. Unilateral contact computes all lanes in advance,
// tooth pair by tooth pair; the other laws compute each lane on demand. deflection(x, lane) gives
// the pair's deflection from positions, and its rate from velocities.
template <class Mesh, int W, class Real, class Deflection>
struct PairForce {
    const Deflection& deflection;
    alignas(64) Real ready[Mesh::kHasTeeth ? W : 1];

    template <class Pairs>
    GEARPOD_INLINE PairForce(const Pairs& m, int pair, const Deflection& deflection_of,
                             const Real* __restrict q, const Real* __restrict v)
        : deflection(deflection_of) {
        if constexpr (Mesh::kHasTeeth) {
            alignas(64) Real d[W], r[W];
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                d[l] = deflection(q, l);
                r[l] = deflection(v, l);
            }
            Mesh::template forces<W>(m, pair, d, r, ready);
        }
    }
    template <class Pairs>
    GEARPOD_INLINE Real operator()(const Pairs& m, int pair, int l, const Real* __restrict q,
                                   const Real* __restrict v) const {
        if constexpr (Mesh::kHasTeeth) {
            return ready[l];
        } else {
            return Mesh::force(m, pair * W + l, l, deflection(q, l), deflection(v, l));
        }
    }
};
template <class Mesh, int W, class Pairs, class Deflection, class Real>
GEARPOD_INLINE auto pair_force(const Pairs& m, int pair, const Deflection& deflection,
                               const Real* q, const Real* v) {
    return PairForce<Mesh, W, Real, Deflection>(m, pair, deflection, q, v);
}

// Calls f with the law of `kind`.
template <typename F>
constexpr auto with_mesh_law(MeshLaw kind, F&& f) {
    switch (kind) {
#define GEARPOD_MESH_LAW(NAME, TYPE, ...) \
    case MeshLaw::NAME:                   \
        return f(TYPE{});
#include "dynamics/effects/mesh_laws.def"
#undef GEARPOD_MESH_LAW
    }
    return f(LinearMesh{});
}

// Properties of a law: static transmission error, separation of flanks, and single tooth pairs.
constexpr bool has_error(MeshLaw law) {
    return with_mesh_law(law, [](auto mesh) { return mesh.kHasError; });
}
constexpr bool separates(MeshLaw law) {
    return with_mesh_law(law, [](auto mesh) { return mesh.kSeparates; });
}
constexpr bool has_teeth(MeshLaw law) {
    return with_mesh_law(law, [](auto mesh) { return mesh.kHasTeeth; });
}

}  // namespace gearpod::dynamics
