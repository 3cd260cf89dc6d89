// Closed forms of the sources as printed (corrections marked), integrated by Boost's tanh-sinh
// rule. The evaluation shares neither formulas nor quadrature with the code. Compliances in m/N.
#pragma once

#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/math/tools/roots.hpp>

#include "stiffness/teeth/tooth_compliance.hpp"
#include "tests/test.hpp"

namespace printed {

inline constexpr double kPi = std::numbers::pi;

// Checks each part of a compliance to a fraction of it.
inline void check_equal(const gearpod::stiffness::ToothCompliance& computed,
                        const gearpod::stiffness::ToothCompliance& expected, double share = 1e-9) {
    CHECK(computed.bending == Approx(expected.bending).epsilon(share));
    CHECK(computed.shear == Approx(expected.shear).epsilon(share));
    CHECK(computed.axial == Approx(expected.axial).epsilon(share).margin(1e-30));
}

template <typename F>
double integral(F&& f, double from, double to) {
    boost::math::quadrature::tanh_sinh<double> rule(15);
    return from == to ? 0 : rule.integrate(f, from, to, 1e-14);
}

// An external tooth of Tian or Liang, or Liang's internal one; symbols as in the theses.
struct Tooth {
    int N;
    double alpha_0, E, L, nu, module;
    bool internal = false;

    double inv0() const { return std::tan(alpha_0) - alpha_0; }
    double a2() const { return kPi / (2 * N) + (internal ? -inv0() : inv0()); }
    double Rb() const { return N * module / 2 * std::cos(alpha_0); }
    double Rr() const { return (N - 2.5) * module / 2; }
    double involute(double a) const { return std::sin(a) + (a2() - a) * std::cos(a); }

    // Integrands of Tian, Eqs. 2.26, 2.30, 2.32 = Liang, Eqs. 2.2.6-2.2.8, with the sum of the two
    // half thicknesses (in units of R_b) in place of 2 h_x: 3/2 = 12 / 2^3 and so on.
    double bending(double from, double to, double a1, double extra, bool cracked) const {
        const double c = std::cos(a1);
        return integral(
            [&](double a) {
                const double arm = 1 + c * ((a2() - a) * std::sin(a) - std::cos(a));
                const double t = cracked ? extra + involute(a) : 2 * involute(a);
                return 12 * arm * arm * (a2() - a) * std::cos(a) / (E * L * t * t * t);
            },
            from, to);
    }
    double shear(double from, double to, double a1, double extra, bool cracked) const {
        const double c = std::cos(a1);
        return integral(
            [&](double a) {
                const double t = cracked ? extra + involute(a) : 2 * involute(a);
                return 2.4 * (1 + nu) * (a2() - a) * std::cos(a) * c * c / (E * L * t);
            },
            from, to);
    }
    double axial(double from, double to, double a1) const {
        const double s = std::sin(a1);
        return integral(
            [&](double a) { return (a2() - a) * std::cos(a) * s * s / (2 * E * L * involute(a)); },
            from, to);
    }

    // Source: Tian, Eqs. 2.26, 2.30, 2.32.
    gearpod::stiffness::ToothCompliance base_circle(double a1) const {
        return {bending(-a1, a2(), a1, 0, false), shear(-a1, a2(), a1, 0, false),
                axial(-a1, a2(), a1)};
    }

    // Source: Liang, Eqs. 2.2.25-2.2.27 with their phi.
    gearpod::stiffness::ToothCompliance internal_tooth(double b1) const {
        const double phi = a2() + std::tan(std::acos(N * std::cos(alpha_0) / (N + 2.5)));
        return {bending(phi, b1, b1, 0, false), shear(phi, b1, b1, 0, false), axial(phi, b1, b1)};
    }

    double a3() const { return std::asin(Rb() * std::sin(a2()) / Rr()); }
    // Bracket of Eqs. 3.2.13, 3.5.5 and 3.5.13: [1 - (N - 2.5) cos a1 cos a3 / (N cos a0)]^3 - (1 -
    // cos a1 cos a2)^3.
    double straight_bending(double a1) const {
        const double c = std::cos(a1);
        const double low = 1 - (N - 2.5) * c * std::cos(a3()) / (N * std::cos(alpha_0));
        const double high = 1 - c * std::cos(a2());
        return (low * low * low - high * high * high) / (E * L * c);
    }
    double straight_length() const {
        return std::cos(a2()) - (N - 2.5) / (N * std::cos(alpha_0)) * std::cos(a3());
    }

    // Source: Liang, Eqs. 3.2.13-3.2.15; root circle inside the base circle.
    gearpod::stiffness::ToothCompliance root_circle(double a1) const {
        const double c = std::cos(a1), s = std::sin(a1);
        auto sum = base_circle(a1);
        sum.bending += straight_bending(a1) / (2 * std::pow(std::sin(a2()), 3));
        sum.shear += 1.2 * (1 + nu) * c * c * straight_length() / (E * L * std::sin(a2()));
        sum.axial += s * s * straight_length() / (2 * E * L * std::sin(a2()));
        return sum;
    }

    // Angles alpha_4 and alpha_5 of Eq. 3.2.21, by bisection on the radius of the involute.
    double a5() const {
        const auto excess = [&](double a) {
            const double x = std::cos(a) - (a2() - a) * std::sin(a);
            return Rb() * std::hypot(x, involute(a)) - Rr();
        };
        const auto bracket = boost::math::tools::bisect(
            excess, -0.5, a2(), boost::math::tools::eps_tolerance<double>(52));
        return 0.5 * (bracket.first + bracket.second);
    }
    double a4() const { return std::asin(Rb() * involute(a5()) / Rr()); }

    // Source: Liang, Eqs. 3.2.18-3.2.20; root circle outside the base circle.
    gearpod::stiffness::ToothCompliance root_on_involute(double a1) const {
        return {bending(-a1, a5(), a1, 0, false), shear(-a1, a5(), a1, 0, false),
                axial(-a1, a5(), a1)};
    }
};

// A crack of Liang's section 3.5 in an external tooth. Length q is along the crack, also past the
// centre line.
struct CrackedTooth {
    Tooth tooth;
    double q, v;

    bool root_inside_base() const { return tooth.Rr() < tooth.Rb(); }
    double root_angle() const { return root_inside_base() ? tooth.a3() : tooth.a4(); }
    double involute_start() const { return root_inside_base() ? tooth.a2() : tooth.a5(); }
    double half_depth() const { return tooth.Rr() * std::sin(root_angle()) / std::sin(v); }
    // Height of the crack tip in units of R_b: sin a2 - q1 / R_b sin v, then -q2 / R_b sin v.
    // Correction: where the root lies outside the base circle, Eqs. 3.5.18-3.5.25 print sin a2,
    // which is not the root chord at which the crack starts (their own first integrals have R_r sin
    // a4).
    double height() const { return (half_depth() - q) * std::sin(v) / tooth.Rb(); }
    // Boundary -alpha_g (conditions 1, 2) or -alpha_c (3, 4): h_x = |height| on the tip side.
    double boundary() const {
        const auto excess = [&](double a) { return tooth.involute(a) - std::abs(height()); };
        const auto bracket =
            boost::math::tools::bisect(excess, -1.5, std::min(0.0, involute_start()),
                                       boost::math::tools::eps_tolerance<double>(52));
        return 0.5 * (bracket.first + bracket.second);
    }
    // First integrals of Eqs. 3.5.5-3.5.25, with the square that the bending arm lacks in print,
    // and the shear denominator to the power 1 instead of 3. Angle a_r follows from cos a_r = cos
    // a_root - (depth below the chord) / R_r.
    double lengthened(double a1, bool bending) const {
        const double below = std::min(q, 2 * half_depth() - q) * std::cos(v) / tooth.Rr();
        const double root = root_angle();
        const double a_r = std::acos(std::cos(root) - below);
        const double c = std::cos(a1);
        const double h = height() * tooth.Rb() / tooth.Rr();
        return integral(
            [&](double a) {
                const double t = h + std::sin(a);
                const double arm = tooth.Rb() / tooth.Rr() -
                                   (std::cos(a) + std::cos(root) - std::cos(a_r) - below) * c;
                return bending
                           ? 12 * std::sin(a) * arm * arm / (tooth.E * tooth.L * t * t * t)
                           : 2.4 * (1 + tooth.nu) * c * c * std::sin(a) / (tooth.E * tooth.L * t);
            },
            root, a_r);
    }
    // Source: Eqs. 3.5.5-3.5.14 and 3.5.18-3.5.23, conditions 1, 2, 3. Axial: Eqs. 3.2.15, 3.2.20.
    gearpod::stiffness::ToothCompliance compliance(double a1) const {
        const double c = std::cos(a1), end = involute_start();
        const double law_ends = std::clamp(boundary(), -a1, end);
        auto sum = root_inside_base() ? tooth.root_circle(a1) : tooth.root_on_involute(a1);
        const double root_thickness = std::sin(tooth.a2()) + height();
        sum.bending = lengthened(a1, true) + tooth.bending(law_ends, end, a1, height(), true) +
                      tooth.bending(-a1, law_ends, a1, 0, false);
        sum.shear = lengthened(a1, false) + tooth.shear(law_ends, end, a1, height(), true) +
                    tooth.shear(-a1, law_ends, a1, 0, false);
        if (root_inside_base()) {
            sum.bending += 4 * tooth.straight_bending(a1) / std::pow(root_thickness, 3);
            sum.shear += 2.4 * (1 + tooth.nu) * c * c * tooth.straight_length() /
                         (tooth.E * tooth.L * root_thickness);
        }
        return sum;
    }
};

}  // namespace printed
