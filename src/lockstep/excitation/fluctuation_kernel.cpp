#include <cmath>

#include "lockstep/excitation/excitation_rows.hpp"
#include "machine/elementary_functions.hpp"
#include "machine/instruction_sets.hpp"

namespace gearpod::lockstep {
namespace {

constexpr double kTurn = 6.283185307179586477;

template <int W>
GEARPOD_INLINE void add_sines_of_lanes(const SineRows& r) {
    for (int n = 0; n < r.nodes; ++n) {
        const double phase = r.phase[n];
        const double* __restrict time = r.time + n * W;
        double* __restrict sum = r.sum + n * W;
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            const double z = std::fma(r.turns_per_mesh[l], phase,
                                      std::fma(r.turns_per_s[l], time[l], r.turns[l]));
            sum[l] = std::fma(r.amplitude[l], machine::lane_sine_of_turns(z), sum[l]);
        }
        if (r.slope == nullptr) {
            continue;
        }
        double* __restrict slope = r.slope + n * W;
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            const double z = std::fma(r.turns_per_mesh[l], phase,
                                      std::fma(r.turns_per_s[l], time[l], r.turns[l] + 0.25));
            slope[l] = std::fma(kTurn * r.turns_per_mesh[l] * r.amplitude[l],
                                machine::lane_sine_of_turns(z), slope[l]);
        }
    }
}

// Cubic B-spline and its derivative: de Boor, A Practical Guide to Splines.
template <int W>
GEARPOD_INLINE void add_splines_of_lanes(const SplineRows& r) {
    const double last = r.count - 3.0;
    const double* __restrict knots = r.knot;
    const double* __restrict knots_per_s = r.knots_per_s;
    const double* __restrict first_knot = r.first_knot;
    for (int n = 0; n < r.nodes; ++n) {
        const double* __restrict time = r.time + n * W;
        alignas(64) double value[W], slope[W];
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            const double unclamped = std::fma(time[l], knots_per_s[l], first_knot[l]);
            const double low = unclamped > 1.0 ? unclamped : 1.0;
            const double u = low < last ? low : last;
            const int left = static_cast<int>(u);
            const double x = u - left, y = 1.0 - x;
            const int index = (left - 1) * W + l;
            const double a = knots[index], b = knots[index + W], c = knots[index + 2 * W],
                         d = knots[index + 3 * W];
            const double b_weight = 2.0 / 3.0 - x * x * (1.0 - 0.5 * x);
            const double c_weight = 2.0 / 3.0 - y * y * (1.0 - 0.5 * y);
            value[l] = std::fma(y * y * y / 6.0, a,
                                std::fma(b_weight, b, std::fma(c_weight, c, x * x * x / 6.0 * d)));
            slope[l] = std::fma(-0.5 * y * y, a,
                                std::fma(x * (1.5 * x - 2.0), b,
                                         std::fma(y * (2.0 - 1.5 * y), c, 0.5 * x * x * d)));
        }
        double* __restrict sum = r.sum + n * W;
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            sum[l] += value[l];
        }
        if (r.slope == nullptr) {
            continue;
        }
        double* __restrict change = r.slope + n * W;
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            change[l] = std::fma(slope[l], r.knots_per_s[l] * r.period[l], change[l]);
        }
    }
}

// Since dphase/dt = r / T, dr/dt = dr/dphase r / T.
template <int W>
GEARPOD_INLINE void write_values_of_lanes(const SpeedRows& r) {
    for (int n = 0; n < r.nodes; ++n) {
        const double* __restrict variation = r.variation + n * W;
        const double* __restrict slope = r.slope + n * W;
        double* __restrict row = r.rows + (n * r.values + r.first_value) * W;
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            const double speed = 1.0 + variation[l];
            const double change = slope[l] * speed / r.period[l];
            row[l] = r.rotation_m_s[l] * change;
            row[(1 + mesh_period_value) * W + l] = r.period[l] / speed;
            row[(1 + relative_speed_value) * W + l] = speed;
            row[(1 + speed_rate_value) * W + l] = change;
        }
    }
}

}  // namespace

void add_sines(int lanes, const SineRows& rows) {
    machine::with_lanes<8>(lanes,
                           [&]<int W>() { machine::run_kernel<add_sines_of_lanes<W>>(rows); });
}

void add_splines(int lanes, const SplineRows& rows) {
    machine::with_lanes<8>(lanes,
                           [&]<int W>() { machine::run_kernel<add_splines_of_lanes<W>>(rows); });
}

void write_speed_values(int lanes, const SpeedRows& rows) {
    machine::with_lanes<8>(lanes,
                           [&]<int W>() { machine::run_kernel<write_values_of_lanes<W>>(rows); });
}

}  // namespace gearpod::lockstep
