// Liang's gearbox with four planets as a user of a general solver would write it: y' = f(t, y). The
// state y holds the 21 displacements, their velocities and, with a sensor, the 32 states of its
// low-pass on the eight channels. T is a number, or eight of them for as many realizations.
// Source: Liang (2016), Eqs. 4.2.1-4.2.4. Independent of the kernels in src/ apart from the inputs.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

namespace gearpod::peers {

inline constexpr int kPlanets = 4;
inline constexpr int kPairs = 2 * kPlanets;
inline constexpr int kMotions = 9 + 3 * kPlanets;
inline constexpr int kChannels = 2 * kPlanets;
inline constexpr int kMotionStates = 2 * kMotions;              // without the sensor
inline constexpr int kSensing = kMotionStates + 4 * kChannels;  // with it

enum Body { carrier, ring, sun, planet };

// Directions shared by all realizations.
struct Directions {
    double cos_psi[kPlanets], sin_psi[kPlanets];
    double cos_sun[kPlanets], sin_sun[kPlanets];
    double cos_ring[kPlanets], sin_ring[kPlanets];
    double low_pass_rad_s;
};

// Parameters in SI units, with J / r^2 in place of J.
template <class T>
struct Gearbox : Directions {
    T inverse_mass[4], inverse_inertia[4];
    T bearing_stiffness[4], bearing_damping[4];
    T support_stiffness[3], support_damping[3], force[3];
    T speed, pull;  // Omega, r_c Omega^2
};

// Stiffness and damping of the pairs sp1..sp4, rp1..rp4.
template <class T>
struct Meshes {
    T k[kPairs], c[kPairs];
};

// The inline namespace separates builds (CMakeLists.txt): a program must not contain a function
// twice with different options.
inline namespace GEARPOD_PEERS_BUILD {

template <class T>
inline void planet_rates(const Gearbox<T>& g, int n, const Meshes<T>& m, const T* q, const T* v,
                         T* load, T* a) {
    const T *qp = q + 9 + 3 * n, *vp = v + 9 + 3 * n;
    const double cs = g.cos_sun[n], ss = g.sin_sun[n], cr = g.cos_ring[n], sr = g.sin_ring[n];
    const double cp = g.cos_psi[n], sp = g.sin_psi[n];
    const T d_sun = cs * (q[6] - qp[0]) + ss * (q[7] - qp[1]) + q[8] + qp[2];
    const T r_sun = cs * (v[6] - vp[0]) + ss * (v[7] - vp[1]) + v[8] + vp[2];
    const T d_ring = cr * (q[3] - qp[0]) + sr * (q[4] - qp[1]) + q[5] - qp[2];
    const T r_ring = cr * (v[3] - vp[0]) + sr * (v[4] - vp[1]) + v[5] - vp[2];
    const T f_sun = m.k[n] * d_sun + m.c[n] * r_sun;
    const T f_ring = m.k[kPlanets + n] * d_ring + m.c[kPlanets + n] * r_ring;
    const T f_x = g.bearing_stiffness[planet] * (qp[0] - q[0] + sp * q[2]) +
                  g.bearing_damping[planet] * (vp[0] - v[0] + sp * v[2]);
    const T f_y = g.bearing_stiffness[planet] * (qp[1] - q[1] - cp * q[2]) +
                  g.bearing_damping[planet] * (vp[1] - v[1] - cp * v[2]);
    load[0] += f_x;
    load[1] += f_y;
    load[2] += cp * f_y - sp * f_x;
    load[3] -= cr * f_ring;
    load[4] -= sr * f_ring;
    load[5] -= f_ring;
    load[6] -= cs * f_sun;
    load[7] -= ss * f_sun;
    load[8] -= f_sun;
    T* ap = a + 9 + 3 * n;
    const T w = g.speed;
    ap[0] = g.inverse_mass[planet] * (cs * f_sun + cr * f_ring - f_x) +
            w * (2.0 * vp[1] + w * qp[0]) + cp * g.pull;
    ap[1] = g.inverse_mass[planet] * (ss * f_sun + sr * f_ring - f_y) +
            w * (w * qp[1] - 2.0 * vp[0]) + sp * g.pull;
    ap[2] = g.inverse_inertia[planet] * (f_ring - f_sun);
}

template <class T>
inline void accelerations(const Gearbox<T>& g, const Meshes<T>& m, const T* q, const T* v, T* a) {
    T load[9];
    for (int b = 0; b < 3; ++b) {
        const T *qb = q + 3 * b, *vb = v + 3 * b;
        load[3 * b] = -(g.bearing_stiffness[b] * qb[0] + g.bearing_damping[b] * vb[0]);
        load[3 * b + 1] = -(g.bearing_stiffness[b] * qb[1] + g.bearing_damping[b] * vb[1]);
        load[3 * b + 2] =
            g.force[b] - g.support_stiffness[b] * qb[2] - g.support_damping[b] * vb[2];
    }
    for (int n = 0; n < kPlanets; ++n) {
        planet_rates(g, n, m, q, v, load, a);
    }
    const T w = g.speed;
    for (int b = 0; b < 3; ++b) {
        const T *qb = q + 3 * b, *vb = v + 3 * b;
        a[3 * b] = g.inverse_mass[b] * load[3 * b] + w * (2.0 * vb[1] + w * qb[0]);
        a[3 * b + 1] = g.inverse_mass[b] * load[3 * b + 1] + w * (w * qb[1] - 2.0 * vb[0]);
        a[3 * b + 2] = g.inverse_inertia[b] * load[3 * b + 2];
    }
}

// Butterworth filter of order 4 as two sections. u: the channel's acceleration; z: x, x', y, y'.
template <class T>
inline void low_pass(double w, const T& u, const T* z, T* rate) {
    const double w2 = w * w;
    const double b1 = 2.0 * std::cos(std::numbers::pi / 8) * w;
    const double b2 = 2.0 * std::cos(3 * std::numbers::pi / 8) * w;
    rate[0] = z[1];
    rate[1] = w2 * (u - z[0]) - b1 * z[1];
    rate[2] = z[3];
    rate[3] = w2 * (z[0] - z[2]) - b2 * z[3];
}

// Derivative y' of `Size` states: kMotionStates or kSensing.
template <int Size, class T>
inline void rates(const Gearbox<T>& g, const Meshes<T>& m, const T* y, T* dy) {
    const T *q = y, *v = y + kMotions;
    T* a = dy + kMotions;
    for (int i = 0; i < kMotions; ++i) {
        dy[i] = v[i];
    }
    accelerations(g, m, q, v, a);
    if constexpr (Size == kSensing) {
        const T w = g.speed;
        for (int n = 0; n < kPlanets; ++n) {
            const T *qp = q + 9 + 3 * n, *vp = v + 9 + 3 * n, *ap = a + 9 + 3 * n;
            const T* z = y + kMotionStates + 8 * n;
            T* rate = dy + kMotionStates + 8 * n;
            low_pass<T>(g.low_pass_rad_s, ap[0] - w * (2.0 * vp[1] + w * qp[0]), z, rate);
            low_pass<T>(g.low_pass_rad_s, ap[1] - w * (w * qp[1] - 2.0 * vp[0]), z + 4, rate + 4);
        }
    }
}

}  // namespace GEARPOD_PEERS_BUILD

}  // namespace gearpod::peers
