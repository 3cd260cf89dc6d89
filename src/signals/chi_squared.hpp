// Chi-squared variables from normal ones by the inverse transform G = Q(Phi(z)), tabulated.
#pragma once

#include <span>
#include <vector>

namespace gearpod::signals {

// Q: quantile of chi^2 with the given degrees of freedom (Boost.Math), Phi: normal distribution.
// Piecewise polynomials over |z| <= 8.3, beyond which a double never asks (probability 1e-16);
// outside, the value at the end. Relative error below 1e-10 for two or more degrees of freedom.
class ChiSquaredTransform {
  public:
    // Throws std::invalid_argument unless degrees >= 2.
    explicit ChiSquaredTransform(int degrees);

    double operator()(double z) const;
    void from_normal(std::span<double> values) const;  // each z becomes its G

  private:
    std::vector<double> coefficients_;  // [piece][power] in the local variable in [-1, 1]
};

}  // namespace gearpod::signals
