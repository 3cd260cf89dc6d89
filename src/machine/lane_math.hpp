// Elementary functions over lanes, written as straight-line fused multiply-adds. The compiler
// vectorises them, and they give the same bits on every instruction set, which no libm promises.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "machine/dispatch.hpp"

namespace gearpod::machine {

// exp(v), with a relative error below 4e-16 for |v| <= 700. Larger |v| give the value at +-700.
//
// v = k ln 2 + r with |r| <= ln(2)/2. exp(r) is summed from its Taylor series (remainder at most
// 2e-16, at the ends), and 2^k enters the exponent bits. Adding 1.5 * 2^52 rounds to an integer and
// leaves it in the lowest bits of the sum.
GEARPOD_INLINE double lane_exp(double v) {
    constexpr double kRound = 0x1.8p52;
    constexpr double kLog2e = 0x1.71547652b82fep0;
    constexpr double kLn2High = 0x1.62e42fefa39efp-1;
    constexpr double kLn2Low = 0x1.abc9e3b39803fp-56;
    v = v < -700.0 ? -700.0 : v;
    v = v > 700.0 ? 700.0 : v;
    const double shifted = std::fma(v, kLog2e, kRound);
    const double k = shifted - kRound;
    const double r = std::fma(k, -kLn2Low, std::fma(k, -kLn2High, v));
    double sum = 1.0 / 6227020800.0;
    sum = std::fma(sum, r, 1.0 / 479001600.0);
    sum = std::fma(sum, r, 1.0 / 39916800.0);
    sum = std::fma(sum, r, 1.0 / 3628800.0);
    sum = std::fma(sum, r, 1.0 / 362880.0);
    sum = std::fma(sum, r, 1.0 / 40320.0);
    sum = std::fma(sum, r, 1.0 / 5040.0);
    sum = std::fma(sum, r, 1.0 / 720.0);
    sum = std::fma(sum, r, 1.0 / 120.0);
    sum = std::fma(sum, r, 1.0 / 24.0);
    sum = std::fma(sum, r, 1.0 / 6.0);
    sum = std::fma(sum, r, 0.5);
    sum = std::fma(sum, r, 1.0);
    sum = std::fma(sum, r, 1.0);
    const std::uint64_t scale = std::bit_cast<std::uint64_t>(shifted) << 52;
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(sum) + scale);
}

// -ln(x 2^-64) for x in [1, 2^64].
//
// x = 2^k m with m in [sqrt(1/2), sqrt 2). ln m = 2 artanh s with s = (m - 1) / (m + 1) and |s| <
// 0.172, by its series (remainder 3e-18). Near x = 2^64, where the result vanishes, k is 64 and
// nothing cancels.
GEARPOD_INLINE double lane_minus_log(double x) {
    constexpr std::uint64_t kRootHalf = std::bit_cast<std::uint64_t>(0x1.6a09e667f3bcdp-1);
    constexpr double kLn2High = 0x1.62e42fefa39efp-1;
    constexpr double kLn2Low = 0x1.abc9e3b39803fp-56;
    const std::uint64_t bits = std::bit_cast<std::uint64_t>(x);
    const std::uint64_t exponent = (bits - kRootHalf) >> 52;
    const double m = std::bit_cast<double>(bits - (exponent << 52));
    const double k = 64.0 - (std::bit_cast<double>(exponent | 0x4330000000000000) - 0x1p52);
    const double s = (m - 1.0) / (m + 1.0);
    const double q = s * s;
    double sum = 1.0 / 23.0;
    sum = std::fma(sum, q, 1.0 / 21.0);
    sum = std::fma(sum, q, 1.0 / 19.0);
    sum = std::fma(sum, q, 1.0 / 17.0);
    sum = std::fma(sum, q, 1.0 / 15.0);
    sum = std::fma(sum, q, 1.0 / 13.0);
    sum = std::fma(sum, q, 1.0 / 11.0);
    sum = std::fma(sum, q, 1.0 / 9.0);
    sum = std::fma(sum, q, 1.0 / 7.0);
    sum = std::fma(sum, q, 1.0 / 5.0);
    sum = std::fma(sum, q, 1.0 / 3.0);
    const double twice = -2.0 * s;
    const double log_m = std::fma(twice * q, sum, twice);  // -ln m
    return std::fma(k, kLn2High, std::fma(k, kLn2Low, log_m));
}

// sin(x) and cos(x) for |x| <= pi/4 by their Taylor series. The remainders are 5e-17 and 3e-18.
GEARPOD_INLINE double lane_sine(double x) {
    const double q = x * x;
    double sum = -1.0 / 1307674368000.0;
    sum = std::fma(sum, q, 1.0 / 6227020800.0);
    sum = std::fma(sum, q, -1.0 / 39916800.0);
    sum = std::fma(sum, q, 1.0 / 362880.0);
    sum = std::fma(sum, q, -1.0 / 5040.0);
    sum = std::fma(sum, q, 1.0 / 120.0);
    sum = std::fma(sum, q, -1.0 / 6.0);
    return std::fma(x * q, sum, x);
}

GEARPOD_INLINE double lane_cosine(double x) {
    const double q = x * x;
    double sum = 1.0 / 20922789888000.0;
    sum = std::fma(sum, q, -1.0 / 87178291200.0);
    sum = std::fma(sum, q, 1.0 / 479001600.0);
    sum = std::fma(sum, q, -1.0 / 3628800.0);
    sum = std::fma(sum, q, 1.0 / 40320.0);
    sum = std::fma(sum, q, -1.0 / 720.0);
    sum = std::fma(sum, q, 1.0 / 24.0);
    sum = std::fma(sum, q, -0.5);
    return std::fma(sum, q, 1.0);
}

// sin(2 pi z) for |z| < 2^50. The absolute error is below 1e-15, beyond the rounding of z. The
// angle is folded to a quarter turn; the first omitted term of the Taylor series is below 1e-20.
GEARPOD_INLINE double lane_sine_of_turns(double z) {
    constexpr double kRound = 6755399441055744.0;  // 1.5 * 2^52: adding it rounds to an integer
    const double part = z - ((z + kRound) - kRound);
    const double folded = std::fabs(part) > 0.25 ? std::copysign(0.5, part) - part : part;
    constexpr double kTurn = 6.283185307179586477;
    const double x = kTurn * folded;
    const double square = x * x;
    double series = 1.0;
#pragma GCC unroll 12
    for (int n = 24; n >= 2; n -= 2) {
        series = std::fma(-series, square * (1.0 / (n * (n + 1))), 1.0);
    }
    return x * series;
}

}  // namespace gearpod::machine
