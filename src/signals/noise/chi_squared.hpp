// Tabulated inverse transform G = Q(Phi(z)) of standard normal to chi-squared variates.
#pragma once

#include <span>

#include "machine/lanes.hpp"

namespace gearpod::signals {

// Piecewise polynomials for G = Q(Phi(z)) over |z| <= 9.5. Q is the quantile function of chi^2 with
// the given degrees of freedom (Boost.Math), Phi the normal distribution function. All variates of
// normals.hpp lie in that range; outside it the value at its end is used. The relative error is
// below 1e-10.
class ChiSquaredTransform {
  public:
    // Throws std::invalid_argument unless degrees >= 2.
    explicit ChiSquaredTransform(int degrees);

    void from_normal(std::span<double> values) const;  // replaces each z by its G

  private:
    machine::AlignedVector pieces_;  // layout: chi_squared_table.hpp
};

}  // namespace gearpod::signals
