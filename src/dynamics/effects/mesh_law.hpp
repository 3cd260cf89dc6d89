// What force a tooth mesh answers to its deflection d and the rate r of it; one struct a law. The
// force presses the teeth together. e is the static transmission error of the pair, the gap that
// unloaded perfect rotation would leave between its flanks, in metres along the line of action.
//
// Yang (2022), Eqs. 71-72, but a mesh out of contact gives no damping force either; Ambarisha and
// Parker (2007) for the law without back contact.
//
// Where the tooth pairs of a mesh differ, each pushes for itself and none pulls: with stiffness k_j
// and gap e_j of its own a tooth pair carries k_j (d - e - e_j) while that is positive (the thin-
// slice and contact models of Velex and Maatar, J. Sound Vib. 191, 1996, with one slice a pair).
// Pairs coupled through elastic gear bodies have the k_j of all of them in contact.
#pragma once

#include <limits>

#include "dynamics/effects/spring_damper.hpp"

namespace gearpod::dynamics {

// with_error: k (d - e) + c (d' - e'). separating: the same while d - e > 0; nothing in the gap; on
// the back flanks k (d - e + 2b) + c (d' - e') once d - e < -2b. pushing: the front's force is the
// sum of k_j max(0, d - e - e_j), with c (d' - e') while any of its tooth pairs pushes.
enum class MeshLaw {
#define GEARPOD_MESH_LAW(NAME, ...) NAME,
#include "dynamics/effects/mesh_laws.def"
#undef GEARPOD_MESH_LAW
};

// Backlash 2b of a mesh that never touches on its back flanks.
inline constexpr double kNoBackContact = std::numeric_limits<double>::infinity();

// Tooth pairs of a gear pair that may touch at once under the law `pushing`.
inline constexpr int kMostToothPairs = 3;

// Whether flanks part under that law.
constexpr bool separates(MeshLaw law) {
    return law == MeshLaw::separating || law == MeshLaw::pushing;
}

// Of each law: whether it knows an error of the pair, whether flanks part, and whether it knows the
// tooth pairs one by one.
struct LinearMesh {
    static constexpr bool kHasError = false;
    static constexpr bool kSeparates = false;
    static constexpr bool kHasTeeth = false;

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
        const Real pressed = front > none ? front : back < none ? back : none;
        const Real rate = pressed != none ? r - m.de[i] : none;
        return spring_damper(m.k[i], pressed, m.c[i], rate);
    }
};

// A sum of springs over the tooth pairs; k and c are the totals.
struct PushingMesh {
    static constexpr bool kHasError = true;
    static constexpr bool kSeparates = true;
    static constexpr bool kHasTeeth = true;

    template <int kPairs, int W, class Real = double>
    struct alignas(64) Pairs {
        static constexpr int kRows = kPairs * W;
        Real k[kRows], c[kRows];
        Real e[kRows], de[kRows];
        // [tooth pair][pair][lane], N/m and m; no stiffness where none touches.
        Real tooth_k[kMostToothPairs * kRows], tooth_e[kMostToothPairs * kRows];
        // What tooth_e is made from, the same during the steps [kept_from, kept_until): the gap in
        // the middle of an engagement, and how much it grows along it, m.
        Real gap[kMostToothPairs * kRows], growth[kMostToothPairs * kRows];
        Real backlash[W];
        int kept_from = 0, kept_until = 0;
    };
    template <class Pairs, class Real>
    static GEARPOD_INLINE Real force(const Pairs& m, int i, int lane, Real d, Real r) {
        const Real none = 0;
        const Real front = d - m.e[i];
        Real pressed = none;  // N
        for (int j = kMostToothPairs - 1; j >= 0; --j) {
            const Real own = front - m.tooth_e[j * Pairs::kRows + i];
            pressed = std::fma(m.tooth_k[j * Pairs::kRows + i], own > none ? own : none, pressed);
        }
        const Real back = front + m.backlash[lane];
        pressed = back < none ? std::fma(m.k[i], back, pressed) : pressed;
        const Real rate = pressed != none ? r - m.de[i] : none;
        return std::fma(m.c[i], rate, pressed);
    }
};

}  // namespace gearpod::dynamics
