#include "signals/noise/tone_sample.hpp"
#include "signals/path/path_weights.hpp"
#include "signals/path/planet_count.hpp"
#include "signals/path/resultant.hpp"
#include "signals/sensor/time_signal.hpp"

namespace gearpod::signals {
namespace {

template <int N>
GEARPOD_INLINE void weights_of_turn(const PathGrid& path, double exponent, double* whole_steps,
                                    double* weight) {
    whole_step_table<1>(path.positions(), &exponent, whole_steps);
    for (long p = 0; p < path.phases(); ++p) {
        path_weights<N, 1>(path, p, &exponent, whole_steps, weight + p * path.positions() * N);
    }
}

template <int N>
GEARPOD_INLINE void signal_of_mesh(const PathGrid& path, const double* weight, int c,
                                   const double* accel, double* signal) {
    for (long p = 0; p < path.phases(); ++p) {
        const long place = p * path.positions() + c;
        signal[p] = resultant<N, 1>(accel + p * 2 * N, weight + place * N, path.sine()[place],
                                    path.cosine()[place], 0);
    }
}

GEARPOD_INLINE void weights_for(const PathGrid& path, double exponent, double* whole_steps,
                                double* weight) {
    with_planets(
        path.planets(), [&]<int N>() __attribute__((always_inline)) {
            weights_of_turn<N>(path, exponent, whole_steps, weight);
        });
}

GEARPOD_INLINE void signal_for(const PathGrid& path, const double* weight, int c,
                               const double* accel, double* signal) {
    with_planets(
        path.planets(), [&]<int N>() __attribute__((always_inline)) {
            signal_of_mesh<N>(path, weight, c, accel, signal);
        });
}

GEARPOD_INLINE void tones_of_mesh(const ToneTable& table, long i, long meshes, long phases,
                                  double* signal) {
    const long tones = table.tones();
    for (long p = 0; p < phases; ++p) {
        for (long t = 0; t < tones; ++t) {
            signal[p] = plus_tone(
                signal[p], table.mesh_sine()[t * meshes + i], table.mesh_cosine()[t * meshes + i],
                table.phase_sine()[p * tones + t], table.phase_cosine()[p * tones + t]);
        }
    }
}

}  // namespace

GEARPOD_KERNEL(all_path_weights,
               (const PathGrid& path, double exponent, double* whole_steps, double* weight),
               (path, exponent, whole_steps, weight),
               weights_for(path, exponent, whole_steps, weight))
GEARPOD_KERNEL(mesh_signal,
               (const PathGrid& path, const double* weight, int c, const double* accel,
                double* signal),
               (path, weight, c, accel, signal), signal_for(path, weight, c, accel, signal))

GEARPOD_KERNEL(add_tones, (const ToneTable& table, int i, int meshes, int phases, double* signal),
               (table, i, meshes, phases, signal), tones_of_mesh(table, i, meshes, phases, signal))

}  // namespace gearpod::signals
