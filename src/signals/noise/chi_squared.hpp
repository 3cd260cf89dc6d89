// Chi-squared variates from normal ones, by a table of polynomials.
#pragma once

#include <span>

#include "machine/lanes.hpp"

namespace gearpod::signals {

// The range |z| <= kChiRange is divided into kChiPieces pieces of equal width. Each piece is a
// polynomial of kChiPowers coefficients in the position within it, -1 to 1, and occupies one cache
// line.
inline constexpr double kChiRange = 9.5;
inline constexpr int kChiPieces = 1024;
inline constexpr int kChiPowers = 6;
inline constexpr int kChiStride = 8;

// Replaces every value z by the polynomial of its piece; beyond the range, by the value at its end.
void chi_squared_values(long values, const double* pieces, double* value);

// Tabulated inverse transform G = Q(Phi(z)) of standard normal to chi-squared variates.

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
    machine::AlignedVector pieces_;
};

}  // namespace gearpod::signals
