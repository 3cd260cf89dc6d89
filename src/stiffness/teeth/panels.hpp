// Division of a stretch of the beam into panels with smooth integrands, and the Gauss rule on a
// panel.
#pragma once

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <stdexcept>

namespace gearpod::stiffness {

// Calls panel(a, b) for each panel of [from, to], in order; `to` may lie below `from`. The
// thickness changes by at most a factor of 1.5 on a panel. The pole of 1 / t^3 then lies at least
// two panel lengths outside it, where a Gauss rule of n points converges as 9.9^(-2 n). An extremum
// of the thickness may lie only where it is nearly constant. Throws std::logic_error unless the
// thickness is positive.
template <typename Thickness, typename Panel>
void for_panels(double from, double to, Thickness&& thickness, Panel&& panel) {
    constexpr double kMaxRatio = 1.5;
    double here = thickness(from);
    while (from != to) {
        double next = to;
        double there = thickness(next);
        if (!(here > 0 && there > 0)) {
            throw std::logic_error("a section of the beam has no thickness");
        }
        while (there > kMaxRatio * here || here > kMaxRatio * there) {
            next = 0.5 * (from + next);
            there = thickness(next);
        }
        panel(from, next);
        from = next;
        here = there;
    }
}

// Calls add(weight, position) at the points of a Gauss rule on the panel. Weights are positive.
template <int kPoints, typename Add>
void for_gauss_points(double from, double to, Add&& add) {
    using Rule = boost::math::quadrature::gauss<double, kPoints>;
    const double middle = 0.5 * (from + to), half = 0.5 * std::abs(to - from);
    for (int i = 0; i < kPoints / 2; ++i) {
        const double offset = half * Rule::abscissa()[i];
        const double weight = half * Rule::weights()[i];
        add(weight, middle - offset);
        add(weight, middle + offset);
    }
}

}  // namespace gearpod::stiffness
