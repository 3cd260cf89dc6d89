// exp over lanes: one straight line of fused multiply-adds that the compiler vectorises and that
// gives the same bits on every instruction set, which no libm promises.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "machine/dispatch.hpp"

namespace gearpod::signals {

// Relative error below 4e-16 for |v| <= 700; beyond, the value at +-700.
// v = k ln 2 + r with |r| <= ln(2)/2; exp(r) by its Taylor series (remainder 2e-16 at worst, at the
// ends); 2^k enters the exponent bits. Adding 1.5 * 2^52 rounds to an integer and leaves it in the
// lowest bits of the sum.
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

}  // namespace gearpod::signals
