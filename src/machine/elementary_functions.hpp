// Elementary functions over lanes, written as straight-line fused multiply-adds. The compiler
// vectorises them, and they give the same bits on every instruction set, which no libm promises.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "machine/instruction_sets.hpp"

namespace gearpod::machine {

// Polynomial in x with these coefficients, from that of the highest power to the constant one.
template <class... Coefficients>
GEARPOD_INLINE double horner(double x, double sum, Coefficients... next) {
    ((sum = std::fma(sum, x, next)), ...);
    return sum;
}

// (exp(r) - 1) / r for |r| <= ln(2)/2 from the Taylor series of exp(r), whose remainder is at most
// 2e-16, at the ends.
GEARPOD_INLINE double lane_exp_quotient(double r) {
    return horner(r, 1.0 / 6227020800.0, 1.0 / 479001600.0, 1.0 / 39916800.0, 1.0 / 3628800.0,
                  1.0 / 362880.0, 1.0 / 40320.0, 1.0 / 5040.0, 1.0 / 720.0, 1.0 / 120.0, 1.0 / 24.0,
                  1.0 / 6.0, 0.5, 1.0);
}

// exp(v), with a relative error below 4e-16 for |v| <= 700. Larger |v| give the value at +-700.
//
// v = k ln 2 + r with |r| <= ln(2)/2, and 2^k enters the exponent bits. Adding 1.5 * 2^52 rounds to
// an integer and leaves it in the lowest bits of the sum.
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
    const double sum = std::fma(lane_exp_quotient(r), r, 1.0);
    const std::uint64_t scale = std::bit_cast<std::uint64_t>(shifted) << 52;
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(sum) + scale);
}

// 1 - exp(-v) for v >= 0, with a relative error below 4e-16.
GEARPOD_INLINE double lane_one_minus_exp(double v) {
    constexpr double kHalfLn2 = 0x1.62e42fefa39efp-2;
    const double near = v < kHalfLn2 ? v : kHalfLn2;
    const double far = 1.0 - lane_exp(-v);
    return v < kHalfLn2 ? near * lane_exp_quotient(-near) : far;
}

// -ln(x 2^-kScale) for normal positive x.
//
// x = 2^k m with m in [sqrt(1/2), sqrt 2). ln m = 2 artanh s with s = (m - 1) / (m + 1) and |s| <
// 0.172, by its series (remainder 3e-18). Near x = 2^kScale, where the result vanishes, k is kScale
// and nothing cancels.
template <int kScale>
GEARPOD_INLINE double lane_minus_scaled_log(double x) {
    constexpr std::uint64_t kRootHalf = std::bit_cast<std::uint64_t>(0x1.6a09e667f3bcdp-1);
    constexpr std::uint64_t kBias = 1023;  // keeps the exponent's bits positive
    constexpr double kLn2High = 0x1.62e42fefa39efp-1;
    constexpr double kLn2Low = 0x1.abc9e3b39803fp-56;
    const std::uint64_t bits = std::bit_cast<std::uint64_t>(x);
    const std::uint64_t exponent = (bits + (kBias << 52) - kRootHalf) >> 52;
    const double m = std::bit_cast<double>(bits - ((exponent - kBias) << 52));
    const double k =
        kScale + 1023.0 - (std::bit_cast<double>(exponent | 0x4330000000000000) - 0x1p52);
    const double s = (m - 1.0) / (m + 1.0);
    const double q = s * s;
    const double sum = horner(q, 1.0 / 23.0, 1.0 / 21.0, 1.0 / 19.0, 1.0 / 17.0, 1.0 / 15.0,
                              1.0 / 13.0, 1.0 / 11.0, 1.0 / 9.0, 1.0 / 7.0, 1.0 / 5.0, 1.0 / 3.0);
    const double twice = -2.0 * s;
    const double log_m = std::fma(twice * q, sum, twice);  // -ln m
    return std::fma(k, kLn2High, std::fma(k, kLn2Low, log_m));
}

// -ln(x 2^-64) for x in [1, 2^64].
GEARPOD_INLINE double lane_minus_log(double x) {
    return lane_minus_scaled_log<64>(x);
}

// ln x for normal positive x.
GEARPOD_INLINE double lane_log(double x) {
    return -lane_minus_scaled_log<0>(x);
}

// erfc(x) for x >= 0, with a relative error below 2e-15 up to x = 26. Larger x give 1e-305 or less.
//
// (1 + 2 x) exp(x^2) erfc(x) is smooth in t = (x - 3.75) / (x + 3.75): M. M. Shepherd, J. G.
// Laframboise, Math. Comp. 36 (1981), 249-253. The polynomial is its Chebyshev series, computed
// with 60 digits and cut where terms are below 6e-17.
GEARPOD_INLINE double lane_erfc(double x) {
    const double square = x * x;
    const double lost = std::fma(x, x, -square);  // by the rounding of the square
    const double decay = lane_exp(-square);
    const double t = (x - 3.75) / (x + 3.75);
    const double sum =
        horner(t, 3.1114333809799251993e-10, -2.6231073471334757612e-9, -3.7442100809620186444e-9,
               3.1979266716668042918e-8, 2.3263508708859123732e-8, -2.4857126248016742872e-7,
               -5.7218230603224087501e-8, 1.7419821586224815923e-6, -9.7355989673677493407e-7,
               -0.000011438048033346893551, 0.00002238423915508222982, 0.000051646529741774161256,
               -0.00029015408054084171105, 0.00029371437804495802994, 0.0017556258528952953569,
               -0.0097465796832652622308, 0.028362277418956404286, -0.058693398576649338403,
               0.09230432116037747776, -0.10880393014244461271, 0.082276738490145207683,
               0.0035854154854790256379, -0.14024059858554696245, 1.2375126308378275289);
    const double scaled = sum / std::fma(2.0, x, 1.0);
    return decay * std::fma(-scaled, lost, scaled);
}

// sin(x) and cos(x) for |x| <= pi/4 by their Taylor series. The remainders are 5e-17 and 3e-18.
GEARPOD_INLINE double lane_sine(double x) {
    const double q = x * x;
    const double sum = horner(q, -1.0 / 1307674368000.0, 1.0 / 6227020800.0, -1.0 / 39916800.0,
                              1.0 / 362880.0, -1.0 / 5040.0, 1.0 / 120.0, -1.0 / 6.0);
    return std::fma(x * q, sum, x);
}

GEARPOD_INLINE double lane_cosine(double x) {
    const double q = x * x;
    return horner(q, 1.0 / 20922789888000.0, -1.0 / 87178291200.0, 1.0 / 479001600.0,
                  -1.0 / 3628800.0, 1.0 / 40320.0, -1.0 / 720.0, 1.0 / 24.0, -0.5, 1.0);
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

// Sine and cosine of the angles along a tooth's flank by their Taylor series. They give the same
// bits on every processor, like the library's functions (machine/portable_libm.cpp), at a tenth of
// their cost.
struct SineCosine {
    double sine, cosine;
};

// Sine and cosine of an angle, rad, with an absolute error below 2e-16.
inline SineCosine sine_cosine(double angle) {
    constexpr double kLargest = 0.8;  // rad; the first omitted term is below 1e-20
    if (!(std::abs(angle) <= kLargest))
        return {std::sin(angle), std::cos(angle)};
    const double x = angle * angle;
    double sine = 1, cosine = 1;
    for (int n = 18; n >= 2; n -= 2) {
        sine = 1 - sine * x * (1.0 / (n * (n + 1)));
        cosine = 1 - cosine * x * (1.0 / (n * (n - 1)));
    }
    return {angle * sine, cosine};
}

}  // namespace gearpod::machine
