// Elastic annulus in plane strain, fixed on one circle and loaded on the other, harmonic by
// harmonic (Michell's solution in the form of Kolosov and Muskhelishvili). Lengths are in units of
// the loaded circle's radius, tractions in units of Young's modulus. On the loaded circle the
// tractions
//
//     t_r = T_r cos n phi, t_phi = T_t sin n phi   give   u_r = U cos n phi, u_phi = V sin n phi;
//
// rotated by a quarter of the period, t_r = T_r sin, t_phi = -T_t cos give U sin, -V cos.
#pragma once

namespace gearpod::stiffness {

// Compliance of one harmonic: U = rr T_r + rt T_t, V = rt T_r + tt T_t, symmetric (Betti). Harmonic
// 0 has rt = 0, and its tt is the twist u_phi under a uniform t_phi.
struct HarmonicCompliance {
    double rr = 0, rt = 0, tt = 0;
};

class Annulus {
  public:
    // held_radius: radius of the fixed circle. Below 1, the loaded circle is the outer one; above
    // 1, the inner one.
    Annulus(double held_radius, double poisson_ratio);

    HarmonicCompliance harmonic(int n) const;
    // Limits of harmonic(n) for large n, with all 1 / (n +- 1) replaced by 1 / n: rr = tt = even /
    // n, rt = odd / n.
    double limit_even() const;
    double limit_odd() const;

  private:
    HarmonicCompliance without_held_circle(int n) const;
    HarmonicCompliance mean() const;

    double held_;
    double shear_;      // G / E
    double kappa_;      // 3 - 4 nu
    double lame_;       // lambda / E
    double outwards_;   // 1: the loaded circle is the outer one; -1: the inner one
    int far_harmonic_;  // from this harmonic on the fixed circle has no effect
};

}  // namespace gearpod::stiffness
