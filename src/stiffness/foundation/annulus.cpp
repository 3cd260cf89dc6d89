#include "stiffness/foundation/annulus.hpp"

#include <Eigen/Dense>
#include <cmath>

namespace gearpod::stiffness {

namespace {

// Amplitudes of u_r = U cos n phi, u_phi = V sin n phi at one radius, with their derivatives by r.
struct Field {
    double U, V, dU, dV;
};

// Field (U, V) (r / reference)^power.
Field power_field(double U, double V, double power, double r, double reference) {
    const double f = std::pow(r / reference, power);
    return {U * f, V * f, U * f * power / r, V * f * power / r};
}

}  // namespace

Annulus::Annulus(double held_radius, double poisson_ratio)
    : held_(held_radius),
      shear_(1 / (2 * (1 + poisson_ratio))),
      kappa_(3 - 4 * poisson_ratio),
      lame_(poisson_ratio / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio))),
      outwards_(held_radius < 1 ? 1 : -1),
      // Condition (inner / outer)^(2 n) < 1e-17, with a margin for the factors n^2 before it.
      far_harmonic_(static_cast<int>(26 / std::abs(std::log(held_radius))) + 8) {}

double Annulus::limit_even() const {
    return (kappa_ + 1) / (4 * shear_);
}
double Annulus::limit_odd() const {
    return outwards_ * (kappa_ - 1) / (4 * shear_);
}

HarmonicCompliance Annulus::harmonic(int n) const {
    if (n == 0)
        return mean();
    if (n >= far_harmonic_)
        return without_held_circle(n);
    const double growing = held_ < 1 ? 1 : held_, falling = held_ < 1 ? held_ : 1;
    const auto field = [&](int which, double r) -> Field {
        switch (which) {
            case 0:
                return power_field(kappa_ - (n + 1), kappa_ + (n + 1), n + 1, r, growing);
            case 1:
                return power_field(-1, 1, n - 1, r, growing);
            case 2:
                return power_field(-1, -1, -n - 1, r, falling);
        }
        if (n > 1)
            return power_field(kappa_ - (1 - n), -(kappa_ + (1 - n)), 1 - n, r, falling);
        const double turn = 2 * kappa_ * std::log(r / falling);
        return {turn - 1, -(turn + 1), 2 * kappa_ / r, -2 * kappa_ / r};
    };
    // Rows: displacements of the fixed circle, tractions (acting on the body) of the loaded circle.
    Eigen::Matrix4d conditions;
    Eigen::Matrix<double, 2, 4> loaded;
    for (int j = 0; j < 4; ++j) {
        const Field held = field(j, held_), at = field(j, 1);
        const double dilatation = at.dU + at.U + n * at.V;
        conditions.col(j) << held.U, held.V, outwards_ * (lame_ * dilatation + 2 * shear_ * at.dU),
            outwards_ * shear_ * (-n * at.U + at.dV - at.V);
        loaded.col(j) << at.U, at.V;
    }
    Eigen::Matrix<double, 4, 2> unit = Eigen::Matrix<double, 4, 2>::Zero();
    unit(2, 0) = unit(3, 1) = 1;
    const Eigen::Matrix2d c = loaded * conditions.fullPivLu().solve(unit);
    return {c(0, 0), 0.5 * (c(0, 1) + c(1, 0)), c(1, 1)};
}

// Full disc, or hole in the infinite plane: only the first two or the last two fields.
HarmonicCompliance Annulus::without_held_circle(int n) const {
    const double near = kappa_ / (n + outwards_), far = 1 / (n - outwards_);
    const double even = (near + far) / (4 * shear_), odd = (near - far) / (4 * shear_);
    return {even, outwards_ * odd, even};
}

HarmonicCompliance Annulus::mean() const {
    // Fields u_r = r - held^2 / r and u_phi = held^2 / r - r.
    const double square = held_ * held_;
    const double radial = 2 * lame_ + 2 * shear_ * (1 + square);
    return {outwards_ * (1 - square) / radial, 0,
            outwards_ * (square - 1) / (shear_ * -2 * square)};
}

}  // namespace gearpod::stiffness
