#include <bit>
#include <cmath>
#include <numbers>

#include "machine/dispatch.hpp"
#include "signals/noise/normal_blocks.hpp"
#include "signals/noise/normals.hpp"

namespace gearpod::signals {
namespace {

constexpr int kPairs = kNormalBlock / 2;

// The word as a number in [1, 2^64], rounded once: its upper and lower half each become the lowest
// bits of a double. Odd, for the middle of each pair of words.
GEARPOD_INLINE double to_double(std::uint64_t word) {
    constexpr std::uint64_t kHighBits = 0x4530000000000000;  // 2^84
    constexpr std::uint64_t kLowBits = 0x4330000000000000;   // 2^52
    const std::uint64_t odd = word | 1;
    const double high = std::bit_cast<double>((odd >> 32) | kHighBits);
    const double low = std::bit_cast<double>((odd & 0xffffffff) | kLowBits);
    return (high - (0x1p84 + 0x1p52)) + low;
}

// -ln(x 2^-64), x in [1, 2^64]. x = 2^k m with m in [sqrt(1/2), sqrt 2); ln m = 2 artanh s,
// s = (m - 1) / (m + 1), |s| < 0.172, by its series (remainder 3e-18). Towards x = 2^64, where the
// result vanishes, k is 64 and nothing cancels.
GEARPOD_INLINE double minus_log(double x) {
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

// Taylor series on |x| <= pi/4; remainders 5e-17 and 3e-18.
GEARPOD_INLINE double sine(double x) {
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

GEARPOD_INLINE double cosine(double x) {
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

// The upper 52 bits of the angle's word are an angle in (-pi/4, pi/4), in the middle of each step;
// of the lower two one turns it to the opposite side, the other reflects it about the diagonal.
GEARPOD_INLINE void all_blocks(long blocks, const std::uint64_t* __restrict words,
                               double* __restrict normals) {
    for (long block = 0; block < blocks; ++block) {
        const std::uint64_t* __restrict radius = words + block * 2 * kPairs;
        const std::uint64_t* __restrict angle = radius + kPairs;
        double* __restrict first = normals + block * 2 * kPairs;
        double* __restrict second = first + kPairs;
#pragma omp simd
        for (int l = 0; l < kPairs; ++l) {
            const double r = std::sqrt(2.0 * minus_log(to_double(radius[l])));
            const std::uint64_t bits = angle[l];
            const double step = std::bit_cast<double>((bits >> 12) | 0x3ff0000000000000);
            const double fraction = (step - 1.5) + 0x1p-53;  // exact
            const double x = fraction * (0.5 * std::numbers::pi);
            const double s = r * sine(x);
            const double c =
                std::bit_cast<double>(std::bit_cast<std::uint64_t>(r * cosine(x)) ^ (bits << 63));
            const bool reflected = (bits & 2) != 0;
            first[l] = reflected ? s : c;
            second[l] = reflected ? c : s;
        }
    }
}

}  // namespace

GEARPOD_KERNEL(normal_blocks, (long blocks, const std::uint64_t* words, double* normals),
               (blocks, words, normals), all_blocks(blocks, words, normals))

}  // namespace gearpod::signals
