// Chi-squared variables from normal ones by the inverse transform G = Q(Phi(z)), tabulated.
#pragma once

#include <span>

#include "machine/lanes.hpp"

namespace gearpod::signals {

// Q: quantile of chi^2 with the given degrees of freedom (Boost.Math), Phi: normal distribution.
// Piecewise polynomials over |z| <= 9.5, beyond which none of normals.hpp lies; outside, the value
// at the end. Relative error below 1e-10 for two or more degrees of freedom.
class ChiSquaredTransform {
  public:
    // Throws std::invalid_argument unless degrees >= 2.
    explicit ChiSquaredTransform(int degrees);

    void from_normal(std::span<double> values) const;  // each z becomes its G

  private:
    machine::AlignedVector pieces_;  // chi_squared_table.hpp
};

}  // namespace gearpod::signals
