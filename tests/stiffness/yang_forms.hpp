// Yang (2022) as printed: the transition curve (Eqs. 10-15), the healthy tooth (Eqs. 16-18) and the
// section laws of his cracks (Eqs. 28-29, 32-33, 40-41, 44-45) with the limits of their closed
// forms.
// The evaluation solves his equations by bisection and integrates over x by Boost's tanh-sinh rule,
// the involute like the fillet. It shares neither coordinates, formulas nor quadrature with the
// code. Compliances in m/N.
#pragma once

#include "gears/gear.hpp"
#include "tests/stiffness/printed_forms.hpp"
#include "tests/test.hpp"

namespace yang {

using printed::integral;

template <typename F>
double zero(F&& f, double low, double high) {
    const auto bracket =
        boost::math::tools::bisect(f, low, high, boost::math::tools::eps_tolerance<double>(52));
    return 0.5 * (bracket.first + bracket.second);
}

struct Tooth {
    gearpod::gears::Gear gear;
    double E, L, nu;

    double a2() const {
        const double a0 = gear.pressure_angle_rad;
        return printed::kPi / (2 * gear.teeth) + std::tan(a0) - a0;
    }
    double Rb() const { return gear.base_radius(); }
    double Rr() const { return gear.root_radius(); }
    double rho_t() const {  // Eq. 1
        const double c = gear.dedendum_coefficient - gear.addendum_coefficient;
        return c * gear.module_m / (1 - std::sin(gear.pressure_angle_rad));
    }
    double alpha_te(double Rte) const {  // Eq. 10
        return std::sqrt(Rte * Rte / (Rb() * Rb()) - 1) - a2();
    }
    double h_at(double a) const { return Rb() * ((a + a2()) * std::cos(a) - std::sin(a)); }
    double x_at(double a) const { return Rb() * ((a + a2()) * std::sin(a) + std::cos(a)); }
    double x_t(double Rte) const {  // Eqs. 12-13
        return Rte * std::cos(std::asin(h_at(alpha_te(Rte)) / Rte)) +
               rho_t() * std::sin(alpha_te(Rte));
    }
    double y_t(double Rte) const {  // Eq. 14
        return h_at(alpha_te(Rte)) + rho_t() * std::cos(alpha_te(Rte));
    }
    double Rte() const {  // Eq. 15
        return zero([&](double r) { return std::hypot(x_t(r), y_t(r)) - (Rr() + rho_t()); }, Rb(),
                    gear.pitch_radius());
    }
    double x_r() const {  // where the arc touches the root circle
        const double r = Rte();
        return Rr() * x_t(r) / (Rr() + rho_t());
    }

    // One crack, starting at height l above the root section.
    struct Crack {
        double q, gamma, l;
    };
    // Source: Eqs. 2, 3, 5-9 between the sections with the cracked thickness; Eqs. 16-18 for q = 0.
    gearpod::stiffness::ToothCompliance compliance(double a1,
                                                   const Crack& crack = {0, 1, 0}) const {
        const double r = Rte(), xt = x_t(r), yt = y_t(r), xr = x_r(), ate = alpha_te(r);
        const double hte = h_at(ate), d1 = x_at(ate) - xr, d = x_at(a1) - xr;
        const auto fillet = [&](double x) {  // Eq. 8
            return yt - std::sqrt(std::max(0.0, rho_t() * rho_t() - std::pow(xt - xr - x, 2)));
        };
        // Source: Eq. 8; the involute's section at x.
        const auto involute = [&](double x) {
            return h_at(zero([&](double a) { return x_at(a) - xr - x; }, -a2(), 1.2));
        };
        const auto h = [&](double x) { return x <= d1 ? fillet(x) : involute(x); };

        const double hcs = crack.l > 0 ? h(crack.l) : fillet(0);
        const double hc = hcs - crack.q * std::sin(crack.gamma);  // Eq. 26
        const double from = std::max(0.0, crack.l - crack.q * std::cos(crack.gamma));
        double until = 0;  // d_c
        if (crack.q > 0 && d > crack.l) {
            if (crack.l < d1 && hc > hte)  // condition 3: Eqs. 36-37
                until = xt - std::sqrt(rho_t() * rho_t() - (yt - hc) * (yt - hc)) - xr;
            else  // conditions 1 and 2: h_x = h_c on the involute outside its thickest section
                until =
                    std::min(d, x_at(zero([&](double a) { return h_at(a) - hc; }, 0, 1.2)) - xr);
        }
        std::array<double, 5> cuts{0, d1, from, until, d};
        for (double& cut : cuts)
            cut = std::clamp(cut, 0.0, d);
        std::sort(cuts.begin(), cuts.end());

        const double c = std::cos(a1), s = std::sin(a1), G = E / (2 * (1 + nu));
        const double arm = Rb() - xr * c;
        gearpod::stiffness::ToothCompliance sum;
        for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
            if (cuts[i + 1] - cuts[i] < 1e-13)
                continue;
            const double middle = 0.5 * (cuts[i] + cuts[i + 1]);
            const bool cracked = middle > from && middle < until;
            const auto part = [&](auto&& f) { return integral(f, cuts[i], cuts[i + 1]); };
            const auto thickness = [&](double x) { return cracked ? hc + h(x) : 2 * h(x); };
            sum.bending += part([&](double x) {
                return 12 * std::pow(arm - x * c, 2) / (E * L * std::pow(thickness(x), 3));
            });
            sum.shear += part([&](double x) { return 1.2 * c * c / (G * L * thickness(x)); });
            sum.axial += part([&](double x) { return s * s / (E * L * 2 * h(x)); });
        }
        return sum;
    }
};

}  // namespace yang
