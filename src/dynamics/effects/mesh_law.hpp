// What force a tooth mesh answers to its deflection d and the rate r of it; one struct a law. The
// force presses the teeth together. e is the static transmission error of the pair, the gap that
// unloaded perfect rotation would leave between its flanks, in metres along the line of action.
//
// Yang (2022), Eqs. 71-72, but a mesh out of contact gives no damping force either; Ambarisha and
// Parker (2007) for the law without back contact.
#pragma once

#include <limits>

#include "dynamics/effects/spring_damper.hpp"

namespace gearpod::dynamics {

// with_error: k (d - e) + c (d' - e'). separating: the same while d - e > 0; nothing in the gap; on
// the back flanks k (d - e + 2b) + c (d' - e') once d - e < -2b.
enum class MeshLaw {
#define GEARPOD_MESH_LAW(NAME, ...) NAME,
#include "dynamics/effects/mesh_laws.def"
#undef GEARPOD_MESH_LAW
};

// Backlash 2b of a mesh that never touches on its back flanks.
inline constexpr double kNoBackContact = std::numeric_limits<double>::infinity();

struct LinearMesh {
    static constexpr bool kHasError = false;
    static constexpr bool kSeparates = false;

    // Of all pairs at one moment: [pair][lane].
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
        const Real pressed = front > none ? front : back < none ? back : none;
        const Real rate = pressed != none ? r - m.de[i] : none;
        return spring_damper(m.k[i], pressed, m.c[i], rate);
    }
};

}  // namespace gearpod::dynamics
