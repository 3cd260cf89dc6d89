// Kernel and table layout of ChiSquaredTransform; see chi_squared.hpp.
#pragma once

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

}  // namespace gearpod::signals
