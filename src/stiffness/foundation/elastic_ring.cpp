#include "stiffness/foundation/elastic_ring.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <cstdlib>
#include <numbers>

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

using std::numbers::pi;

// The omitted terms decrease as 1 / (n^2 half angle) in the self part and as 1 / n^3 in the
// coupling.
constexpr int kHarmonics = 4096;

// Fourier coefficients of 1 (cosines) and of phi (sines) on |phi| <= half_angle, 0 elsewhere.
double constant_coefficient(int n, double half_angle) {
    return 2 * std::sin(n * half_angle) / (pi * n);
}
double linear_coefficient(int n, double half_angle) {
    const double x = n * half_angle;
    return 2 * (std::sin(x) - x * std::cos(x)) / (pi * n * n);
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

ElasticRing::ElasticRing(const ToothProfile& tooth, int teeth, const Material& material,
                         double body_radius_m)
    : half_angle_(tooth.root_half_angle()),
      base_radius_(tooth.base_radius() / tooth.root_radius()),
      outwards_(tooth.internal() ? -1 : 1),
      stretch_(material.youngs_modulus_Pa * material.face_width_m) {
    const Annulus body(body_radius_m / tooth.root_radius(), material.poisson_ratio);
    limit_even_ = body.limit_even();
    limit_odd_ = body.limit_odd();
    const HarmonicCompliance mean = body.harmonic(0);
    displacement_by_shear_ = mean.tt * half_angle_ / pi;
    displacement_by_normal_ = mean.rr * half_angle_ / pi;
    for (auto& work : work_) {
        work[shear][shear] = mean.tt * 2 * half_angle_ * half_angle_ / pi;
        work[normal][normal] = mean.rr * 2 * half_angle_ * half_angle_ / pi;
    }
    for (int n = 1; n <= kHarmonics; ++n) {
        const HarmonicCompliance c = body.harmonic(n);
        add_self_harmonic(n, c);
        add_coupling_harmonic(n, c, teeth);
    }
    add_self_limits();
}

// Adds one harmonic. The slopes' series converge like those of cos(n x) / n and sin(n x) / n, whose
// parts are summed in closed form by add_self_limits().
void ElasticRing::add_self_harmonic(int n, const HarmonicCompliance& c) {
    const double constant = constant_coefficient(n, half_angle_);
    const double linear = linear_coefficient(n, half_angle_);
    displacement_by_shear_ += c.tt * constant;
    displacement_by_linear_ += c.rt * linear;
    slope_by_shear_ += (n * c.rt - limit_odd_) * constant;
    slope_by_linear_ += (n * c.rr - limit_even_) * linear +
                        limit_even_ * 2 * std::sin(n * half_angle_) / (pi * n * n);
    displacement_by_normal_ += c.rr * constant;
}

void ElasticRing::add_self_limits() {
    slope_by_shear_ += limit_odd_ * (1 - half_angle_ / pi);
    slope_by_linear_ +=
        limit_even_ * 2 * half_angle_ / pi * std::log(2 * std::sin(half_angle_ / 2));
}

void ElasticRing::add_coupling_harmonic(int n, const HarmonicCompliance& c, int teeth) {
    const double constant = constant_coefficient(n, half_angle_);
    const double linear = linear_coefficient(n, half_angle_);
    const double cc = pi * constant * constant, cl = pi * constant * linear,
                 ll = pi * linear * linear;
    for (int apart = 1; apart <= kFarthest; ++apart) {
        const double angle = 2 * pi * apart * n / teeth;
        const double cosine = std::cos(angle), sine = outwards_ * std::sin(angle);
        auto& work = work_[apart - 1];
        work[shear][shear] += c.tt * cc * cosine;
        work[shear][linear_normal] += c.rt * cl * cosine;
        work[shear][normal] -= c.rt * cc * sine;
        work[linear_normal][shear] += c.rt * cl * cosine;
        work[linear_normal][linear_normal] += c.rr * ll * cosine;
        work[linear_normal][normal] -= c.rr * cl * sine;
        work[normal][shear] += c.rt * cc * sine;
        work[normal][linear_normal] += c.rr * cl * sine;
        work[normal][normal] += c.rr * cc * cosine;
    }
}

// Amplitudes from the balance of moments about the gear's centre (force times base radius), of
// forces along the root and of forces into the body.
ElasticRing::Stresses ElasticRing::stresses(double contact_angle) const {
    const double a = half_angle_, sine = std::sin(a);
    return {base_radius_ / (2 * a),
            (base_radius_ * sine / a - std::cos(contact_angle)) / (2 * (sine - a * std::cos(a))),
            std::sin(contact_angle) / (2 * sine)};
}

FoundationCompliance ElasticRing::self(double contact_angle) const {
    // Lever cos a1 u / R, in the direction of the force.
    const double lever = base_radius_ - std::cos(contact_angle), radial = std::sin(contact_angle);
    const Stresses contact_stresses = stresses(contact_angle);
    // The linear stress has a part that balances the lever and a small part due to the root's
    // curvature.
    const double by_lever = 1 / (2 * (std::sin(half_angle_) - half_angle_ * std::cos(half_angle_)));
    const double by_curvature = contact_stresses[linear_normal] - by_lever * lever;
    const double displacement =
        displacement_by_shear_ * contact_stresses[shear] + displacement_by_linear_ * by_curvature;
    const double slope =
        slope_by_shear_ * contact_stresses[shear] + slope_by_linear_ * by_curvature;
    return {slope_by_linear_ * by_lever * lever * lever / stretch_,
            (base_radius_ * displacement_by_linear_ * by_lever + slope) * lever / stretch_,
            (base_radius_ * displacement +
             radial * displacement_by_normal_ * contact_stresses[normal]) /
                stretch_};
}

double ElasticRing::coupling(double angle_i, double angle_j, int teeth_apart) const {
    if (teeth_apart == 0 || std::abs(teeth_apart) > kFarthest)
        return 0;
    // Coupling backwards is coupling forwards with the two teeth exchanged.
    const bool forwards = teeth_apart > 0;
    const Stresses from = stresses(forwards ? angle_i : angle_j);
    const Stresses to = stresses(forwards ? angle_j : angle_i);
    const auto& work = work_[std::abs(teeth_apart) - 1];
    double sum = 0;
    for (int row = 0; row < kStresses; ++row)
        for (int column = 0; column < kStresses; ++column)
            sum += to[row] * work[row][column] * from[column];
    return sum / stretch_;
}

}  // namespace gearpod::stiffness
