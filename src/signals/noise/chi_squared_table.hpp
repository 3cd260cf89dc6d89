// The kernel behind ChiSquaredTransform; see chi_squared.hpp.
#pragma once

namespace gearpod::signals {

// |z| <= kChiRange in kChiPieces pieces of equal width, each a polynomial of kChiPowers powers of
// the place in it, -1 to 1. A piece takes a cache line.
inline constexpr double kChiRange = 9.5;
inline constexpr int kChiPieces = 1024;
inline constexpr int kChiPowers = 6;
inline constexpr int kChiStride = 8;

// Every value z becomes its polynomial's; beyond the range, that at its end.
void chi_squared_values(long values, const double* pieces, double* value);

}  // namespace gearpod::signals
