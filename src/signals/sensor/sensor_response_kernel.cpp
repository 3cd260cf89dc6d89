#include "signals/sensor/sensor_response_kernel.hpp"

#include <cmath>

#include "machine/instruction_sets.hpp"
#include "signals/path/path_weights.hpp"

namespace gearpod::signals {
namespace {

template <int W>
GEARPOD_INLINE void all_weights(const PathWeights& a) {
    const PathGrid& path = *a.path;
    const long phases = path.phases(), positions = path.positions();
    whole_step_table<W>(path.positions(), a.exponent, a.whole_steps);
    with_planets(
        path.planets(), [&]<int N>() __attribute__((always_inline)) {
            for (long p = 0; p < phases; ++p) {
                path_weights<N, W>(path, p, a.exponent, a.whole_steps, a.turn);
                for (long c = 0; c < positions; ++c) {
                    double* const to = a.weight + (c * phases + p) * N * W;
                    for (int i = 0; i < N * W; ++i) {
                        to[i] = a.turn[c * N * W + i];
                    }
                }
            }
        });
}

// Adds the tones at phase p to its samples.
template <int W>
GEARPOD_INLINE void add_tones_of_phase(const SensorResponseArguments& a, long p,
                                       double* __restrict y) {
    const long tones = a.tones->tones();
    for (long t = 0; t < tones; ++t) {
        const long mesh = (t * a.meshes + a.mesh) * W, phase = (p * tones + t) * W;
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            y[l] = plus_tone(y[l], a.tones->mesh_sine()[mesh + l], a.tones->mesh_cosine()[mesh + l],
                             a.tones->phase_sine()[phase + l], a.tones->phase_cosine()[phase + l]);
        }
    }
}

template <int N, int W>
GEARPOD_INLINE void compute_mesh_response(const SensorResponseArguments& a) {
    const PathGrid& path = *a.path;
    const double* const first = a.accel + 2L * path.first_source() * W;
    const long row = 2L * a.sources * W;
    for (long p = 0; p < path.phases(); ++p) {
        const long index = p * path.positions() + a.carrier;
        const double sine = path.sine()[index], cosine = path.cosine()[index];
        const double* __restrict accel = first + p * row;
        const double* __restrict weight = a.weight + p * N * W;
        double* __restrict y = a.signal + p * W;
#pragma omp simd
        for (int l = 0; l < W; ++l) {
            y[l] = resultant<N, W>(accel, weight, sine, cosine, l);
        }
        if (a.tones != nullptr) {
            add_tones_of_phase<W>(a, p, y);
        }
        if (a.folded != nullptr) {
            double* __restrict bin = a.folded + p * W;
#pragma omp simd
            for (int l = 0; l < W; ++l) {
                bin[l] = std::fma(y[l], y[l], bin[l]);
            }
        }
    }
}

template <int W>
GEARPOD_INLINE void compute_response(const SensorResponseArguments& a) {
    with_planets(
        a.path->planets(), [&]<int N>()
                               __attribute__((always_inline)) { compute_mesh_response<N, W>(a); });
}

}  // namespace

void sensor_path_weights(int lanes, const PathWeights& a) {
    machine::with_lanes<16>(lanes, [&]<int W>() { machine::run_kernel<all_weights<W>>(a); });
}

void sensor_response(int lanes, const SensorResponseArguments& a) {
    machine::with_lanes<16>(lanes, [&]<int W>() { machine::run_kernel<compute_response<W>>(a); });
}

void path_weights_of_one_lane(const PathWeights& a) {
    machine::run_kernel<all_weights<1>>(a);
}

void sensor_response_of_one_lane(const SensorResponseArguments& a) {
    machine::run_kernel<compute_response<1>>(a);
}

}  // namespace gearpod::signals
