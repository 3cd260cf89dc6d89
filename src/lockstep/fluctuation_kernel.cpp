#include <cmath>

#include "lockstep/fluctuation_rows.hpp"
#include "machine/dispatch.hpp"

namespace gearpod::lockstep {
namespace {

constexpr double kTurn = 6.283185307179586477;

// sin(2 pi z) for |z| < 2^50, in error by less than 1e-15 of 1 beyond the rounding of z: folded to
// a quarter turn, then Taylor's series, whose first term left out is below 1e-20.
GEARPOD_INLINE double sine_of_turns(double z) {
    constexpr double kRound = 6755399441055744.0;  // 1.5 * 2^52: adding it rounds to an integer
    const double part = z - ((z + kRound) - kRound);
    const double folded = std::fabs(part) > 0.25 ? std::copysign(0.5, part) - part : part;
    const double x = kTurn * folded;
    const double square = x * x;
    double series = 1.0;
#pragma GCC unroll 12
    for (int n = 24; n >= 2; n -= 2) {
        series = std::fma(-series, square * (1.0 / (n * (n + 1))), 1.0);
    }
    return x * series;
}

template <int W>
GEARPOD_INLINE void add_sines(const SineRows& r) {
    for (int n = 0; n < r.nodes; ++n) {
        const double phase = r.phase[n];
        const double* __restrict time = r.time + n * W;
        double* __restrict sum = r.sum + n * W;
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            const double z = std::fma(r.turns_per_mesh[l], phase,
                                      std::fma(r.turns_per_s[l], time[l], r.turns[l]));
            sum[l] = std::fma(r.amplitude[l], sine_of_turns(z), sum[l]);
        }
        if (r.slope == nullptr) {
            continue;
        }
        double* __restrict slope = r.slope + n * W;
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            const double z = std::fma(r.turns_per_mesh[l], phase,
                                      std::fma(r.turns_per_s[l], time[l], r.turns[l] + 0.25));
            slope[l] =
                std::fma(kTurn * r.turns_per_mesh[l] * r.amplitude[l], sine_of_turns(z), slope[l]);
        }
    }
}

}  // namespace

GEARPOD_KERNEL(add_sines_8, (const SineRows& rows), (rows), add_sines<8>(rows))
GEARPOD_NARROW_KERNEL(add_sines_4, (const SineRows& rows), (rows), add_sines<4>(rows))
GEARPOD_NARROW_KERNEL(add_sines_1, (const SineRows& rows), (rows), add_sines<1>(rows))

}  // namespace gearpod::lockstep
