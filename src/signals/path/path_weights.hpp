// Weights of the planets' vibration at a sensor, for W gearboxes or one.
#pragma once

#include <cmath>
#include <numbers>

#include "machine/elementary_functions.hpp"
#include "machine/instruction_sets.hpp"
#include "signals/path/transmission_path.hpp"

namespace gearpod::signals {

// Number of planets as a template argument. With unrolled loops over planets, the sums of a sample
// stay in registers.
inline constexpr int kMaxPathPlanets = 8;

// Calls task.operator()<N>() for the given number of planets, 1..kMaxPathPlanets.
template <int N = 1, typename Task>
GEARPOD_INLINE void with_planets(int planets, Task task) {
    if constexpr (N < kMaxPathPlanets) {
        if (planets != N) {
            return with_planets<N + 1>(planets, task);
        }
    }
    task.template operator()<N>();
}

// Sensor value from the planets' accelerations and path weights. The folded signal and the time
// signal share it, so that both give the same bits.

// Sensor value y of lane l from accel[channel][lane] and weight[n][lane].
template <int N, int W>
GEARPOD_INLINE double resultant(const double* __restrict accel, const double* __restrict weight,
                                double sine, double cosine, int l) {
    double along_x = 0.0;
    double along_y = 0.0;
#pragma GCC unroll 8
    for (int n = 0; n < N; ++n) {
        along_x = std::fma(weight[n * W + l], accel[2 * n * W + l], along_x);
        along_y = std::fma(weight[n * W + l], accel[(2 * n + 1) * W + l], along_y);
    }
    return std::fma(sine, along_x, cosine * along_y);
}

// Path weights g(x) over lanes, at all carrier indices of one phase; see PathGrid.

// Fills table[m][lane] with exp(alpha h^2 m^2) for m = 0 .. M_c/2.
template <int W>
GEARPOD_INLINE void whole_step_table(int positions, const double* __restrict exponent,
                                     double* __restrict table) {
    const double h = 2.0 * std::numbers::pi / positions;
    for (int m = 0; m <= positions / 2; ++m) {
        const double square = h * m * (h * m);
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            table[m * W + l] = machine::lane_exp(exponent[l] * square);
        }
    }
}

// Fills weight[c][n][lane] at phase p. Each step multiplies the powers by one factor, so at most
// M_c/2 roundings accumulate.
template <int N, int W>
GEARPOD_INLINE void path_weights(const PathGrid& grid, long p, const double* __restrict exponent,
                                 const double* __restrict table, double* __restrict weight) {
    const int positions = grid.positions();
    const double h = 2.0 * std::numbers::pi / positions;
    const double* window = grid.window() + p * positions * N;
    const int* centre = grid.centre() + p * N;
    alignas(64) double ratio[N * W], inverse[N * W], up[N * W], down[N * W];
    for (int n = 0; n < N; ++n) {
        const double f = grid.fraction()[p * N + n];
        const double linear = 2.0 * h * h * f;
        const double square = h * f * (h * f);
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            ratio[n * W + l] = machine::lane_exp(exponent[l] * linear);
            inverse[n * W + l] = machine::lane_exp(-exponent[l] * linear);
            up[n * W + l] = machine::lane_exp(exponent[l] * square);
            down[n * W + l] = up[n * W + l] * inverse[n * W + l];
        }
    }
    // Upwards from m = 0 and downwards from m = -1, for all planets in parallel.
    const int below = positions / 2;
    for (int m = 0; m < positions - below; ++m) {
        for (int n = 0; n < N; ++n) {
            const int c = centre[n] + m < positions ? centre[n] + m : centre[n] + m - positions;
            const double w = window[c * N + n];
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                weight[(c * N + n) * W + l] = w * table[m * W + l] * up[n * W + l];
                up[n * W + l] *= ratio[n * W + l];
            }
        }
        for (int n = 0; n < N && m < below; ++n) {
            const int c =
                centre[n] - m - 1 >= 0 ? centre[n] - m - 1 : centre[n] - m - 1 + positions;
            const double w = window[c * N + n];
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                weight[(c * N + n) * W + l] = w * table[(m + 1) * W + l] * down[n * W + l];
                down[n * W + l] *= inverse[n * W + l];
            }
        }
    }
}

}  // namespace gearpod::signals
